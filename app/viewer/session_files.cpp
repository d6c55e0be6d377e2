// Files that are asked for, and what stands in for those that are not there.
#include "app/viewer/session.h"

#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

namespace {

/// Runs the job; a mesh that is not there is handed on, with what is to be done once it is found.
template <class Work, class Missing>
void unless_missing(Work&& work, Missing&& missing) {
    try {
        work();
    } catch (const MissingMesh& error) {
        missing(error);
        throw;
    }
}

} // namespace

void Session::open(const std::filesystem::path& file, const std::filesystem::path& mesh) {
    ask("opening " + file.filename().string(), [this, file, mesh](Progress& progress) {
        unless_missing([&] { bench_->open(file, mesh, progress); },
                       [&](const MissingMesh& error) {
                           note_missing(error, [this, file](const auto& found) { open(file, found); });
                       });
    });
}

void Session::recover() {
    if (lost_.empty()) {
        throw InputError("no session was lost");
    }
    recover(lost_.front());
    lost_.clear();
}

void Session::recover(const std::shared_ptr<LostSession>& lost, const std::filesystem::path& mesh) {
    ask("recovering a session", [this, lost, mesh](Progress& progress) {
        unless_missing([&] { bench_->recover(*lost, mesh, progress); },
                       [&](const MissingMesh& error) {
                           note_missing(error, [this, lost](const auto& found) { recover(lost, found); });
                       });
    });
}

/// On the worker's thread.
void Session::note_missing(const MissingMesh& error,
                           std::function<void(const std::filesystem::path&)> go_on) {
    const std::lock_guard lock(mutex_);
    said_missing_ = MissingFile{error.what(), error.mesh(), std::move(go_on)};
}

void Session::take_missing_mesh(const std::filesystem::path& mesh) {
    if (const auto missing = std::exchange(missing_mesh_, std::nullopt)) {
        missing->go_on(mesh);
    }
}

std::optional<std::filesystem::path> Session::take_wanted_file() {
    return std::exchange(wanted_file_, std::nullopt);
}

bool Session::moves() const {
    const std::vector<PickedHandle>& handles = editor.handles();
    return occluders.has_motion() ||
           std::any_of(handles.begin(), handles.end(), [](const PickedHandle& handle) {
               return handle.by != Vec3(0) || handle.degrees != 0 || !handle.way.empty();
           });
}

std::shared_ptr<LostSession> Session::left_behind() const {
    const DocumentState& document = shown_->document;
    if (!document.recipe || (document.recipe->edits.empty() && document.recipe->occluders.empty())) {
        return nullptr;
    }
    auto left = std::make_shared<LostSession>();
    left->recipe = *document.recipe;
    if (shown_->drag) { // what was under way counts as well
        left->recipe.edits.push_back(with_poses(left->recipe, shown_->drag->edit));
    }
    return left;
}

void Session::lose_computing() {
    ask("losing the device", [this](Progress&) { bench_->lose_computing(); });
}

} // namespace anvil
