#include "app/viewer/session.h"

#include "app/backend_choice.h"
#include "app/viewer/window.h"
#include "engine/core/error.h"
#include "engine/core/user_folder.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr double default_radius = 0.15; // of the diagonal
constexpr size_t most_notices = 6;

std::string text_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        return "out of memory; the edit was not taken";
    } catch (const std::exception& e) {
        return e.what();
    }
}

} // namespace

Session::Session(std::shared_ptr<Device> device, const WorkDevice& choice, Disposer& disposer,
                 std::function<void()> changed)
    : device_(std::move(device)), disposer_(disposer), bench_(std::make_unique<Workbench>(device_, choice)),
      mirror_plane_(device_->state()),
      shown_(bench_->shown()), device_choices_{"cpu"}, drivers_{"double precision"}, health_(changed),
      recent_files_(user_state_folder()), recent_(recent_files_.list()) {
    Log log;
    for (LostSession& lost : lost_sessions(user_state_folder(), log)) {
        lost_.push_back(std::make_shared<LostSession>(std::move(lost)));
    }
    for (const DeviceInfo& info : devices_or_none(log)) {
        if (info.usable()) {
            device_choices_.push_back(info.name);
            drivers_.push_back(info.driver);
        }
    }
    for (std::string& warning : log.warnings) {
        notices_.push_back({false, std::move(warning)});
    }
    worker_ = std::make_unique<Worker>([this](const std::exception_ptr& error) { failed(error); },
                                       std::move(changed));
}

Session::~Session() = default;

void Session::failed(const std::exception_ptr& error) {
    const std::lock_guard lock(mutex_);
    said_.push_back({true, text_of(error)});
}

void Session::ask(const std::string& what, Worker::Job job, const std::string& replaces) {
    worker_->add(what, std::move(job), replaces);
}

void Session::forget_lost() {
    for (const auto& lost : lost_) {
        lost->discard();
    }
    lost_.clear();
}

void Session::save(const std::filesystem::path& file) {
    ask("saving " + file.filename().string(), [this, file](Progress&) {
        if (file.extension() == ".json") {
            bench_->save_recipe(file);
        } else {
            bench_->save_mesh(file);
        }
        const std::lock_guard lock(mutex_);
        said_.push_back({false, "saved " + file.string()});
    });
}

void Session::undo() {
    leave_pending();
    ask("undo", [this](Progress& progress) { bench_->undo(progress); });
}

void Session::redo() {
    leave_pending();
    ask("redo", [this](Progress& progress) { bench_->redo(progress); });
}

void Session::use_device(const std::string& choice) {
    ask("changing the device", [this, choice](Progress& progress) { bench_->use_device(choice, progress); });
}

void Session::change(const Recipe& next, const std::string& what, const std::string& merge) {
    ask(
        what, [this, next, what, merge](Progress& progress) { bench_->change(next, what, merge, progress); },
        merge.empty() ? "" : "change " + merge);
    options_changed(); // handles that are placed act on the new state
}

void Session::commit() {
    if (!has_pending()) {
        return;
    }
    if (refused_ && worker_->idle()) { // its handles stay, to be mended
        return complain("the edit cannot be taken as it is; change its handles, radius or curve, or drop it");
    }
    const Edit edit = pending();
    const std::string what = edit.handles.empty()            ? "hammer"
                             : edit.kind == EditKind::rotate ? "turn"
                                                             : "move";
    leave_pending();
    ask(what, [this, edit, what, opening = shown_->opening](Progress& progress) {
        if (bench_->shown()->opening == opening) { // else another file was opened meanwhile
            bench_->commit(edit, what, progress);
        }
    });
}

void Session::drop() {
    worker_->cancel("looking ahead");
    leave_pending();
    ask("dropping the edit", [this](Progress&) { bench_->drop_preview(); });
}

void Session::update() {
    switch (editor.take_wish()) {
    case EditorWish::preview:
        follow();
        break;
    case EditorWish::commit:
        commit();
        break;
    case EditorWish::drop:
        drop();
        break;
    case EditorWish::nothing:
        break;
    }
    follow_occluders();
    take_up();
    trace_line();
}

void Session::take_up() {
    std::shared_ptr<const Shown> before = std::exchange(shown_, bench_->shown());
    if (shown_->document.off != before->document.off) {
        options_changed();
    }
    if (shown_->pick != before->pick) {
        editor.surface_changed(camera, shown_->pick.get());
        line.surface_changed(shown_->pick.get());
        asked_for_.clear();
    }
    disposer_.take(std::move(before));
    for (std::string& warning : bench_->take_warnings()) {
        notices_.push_back({false, std::move(warning)});
    }
    {
        const std::lock_guard lock(mutex_);
        std::move(said_.begin(), said_.end(), std::back_inserter(notices_));
        said_.clear();
        if (said_missing_) {
            missing_mesh_ = std::exchange(said_missing_, std::nullopt);
        }
    }
    if (notices_.size() > most_notices) {
        notices_.erase(notices_.begin(), notices_.end() - most_notices);
    }
    if (shown_->mesh && shown_->document.surface->file != examined_) {
        disposer_.take(std::exchange(examined_, shown_->document.surface->file));
        health_.start(examined_);
    }
    if (shown_->mesh && shown_->opening != opening_) {
        opening_ = shown_->opening;
        take_up_document();
    }
}

/// What was under way was of the one before.
void Session::take_up_document() {
    leave_pending();
    line.surface_changed(nullptr);
    recent_files_.add(shown_->recipe_file.empty() ? shown_->mesh_file : shown_->recipe_file);
    look_for_recent();
    editor.set_lasting_pins({});
    editor.radius = default_radius * bounds().diagonal();
    occluders.set_scene_size(bounds().diagonal() > 0 ? bounds().diagonal() : 1);
    occluders.select("");
    options = {};
    camera.frame(shown_->document.surface->positions, camera.side(Vec3(0.35, 0.25, 1.0)));
}

bool Session::settled() const {
    const std::lock_guard lock(mutex_);
    return worker_->idle() && shown_ == bench_->shown() && said_.empty() && !said_missing_ && !in_motion() &&
           !outcome_due();
}

Box Session::bounds() const {
    return shown_->mesh ? shown_->mesh->box : Box();
}

std::optional<Vec3> Session::under_cursor() const {
    return editor.hover() ? std::optional(editor.hover()->position) : std::nullopt;
}

void Session::frame_all() {
    if (shown_->mesh) {
        camera.frame(shown_->document.surface->positions);
    }
}

void Session::look_from(const Vec3& direction) {
    camera.look_from(direction);
}

void Session::handle(const InputEvent& event) {
    if (event.kind == InputEvent::Kind::drop) {
        if (!event.files.empty()) {
            want_file(event.files.front());
        }
        if (event.files.size() > 1) {
            tell("one file is opened at a time: of " + std::to_string(event.files.size()) + ", " +
                 std::filesystem::path(event.files.front()).filename().string());
        }
        return;
    }
    // A turn of the view in mid-drag is welcome; what it does not take is the editor's.
    const bool camera_first =
        event.kind != InputEvent::Kind::scroll &&
        navigation.handle(event, camera, editor.dragging() ? std::nullopt : under_cursor());
    if (camera_first) {
        return;
    }
    const bool dragging = editor.dragging() || occluders.dragging();
    if (!dragging && (handle_line(event) || handle_selection(event))) {
        return;
    }
    const PickSurface* surface = shown_->pick.get();
    const bool occluders_first = view.occluders && !editor.dragging();
    if ((occluders_first && occluders.handle(event, camera, shown_->occluders, surface)) ||
        editor.handle(event, camera, surface)) {
        return;
    }
    if (event.kind == InputEvent::Kind::scroll) {
        navigation.handle(event, camera, std::nullopt);
        zoomed_at_ = std::chrono::steady_clock::now();
    } else if (event.kind == InputEvent::Kind::key_down) {
        key(event);
    }
}

void Session::key(const InputEvent& event) {
    const int number = event.key;
    if (occluder_key(event)) {
        return;
    }
    if (event.modifiers.control) {
        if (number == 'Z') {
            event.modifiers.shift ? redo() : undo();
        } else if (number == 'Y') {
            redo();
        }
        return;
    }
    const std::array<std::pair<const char*, Vec3>, 3> views{
        {{"1", Vec3(0, 0, 1)}, {"3", Vec3(1, 0, 0)}, {"7", Vec3(0, 1, 0)}}};
    for (const auto& [name, direction] : views) {
        if (number == key_of(name)) {
            look_from(camera.side(event.modifiers.shift ? -direction : direction));
        }
    }
    if (number == '5') {
        camera.orthographic = !camera.orthographic;
    } else if (number == 'F') {
        frame_selection();
    } else if (number == key_of("home")) {
        frame_all();
    } else if (number == 'W') {
        view.edges = !view.edges;
    } else if (number == 'S') {
        view.flat = !view.flat;
    } else if (number == 'I') {
        view.contours = !view.contours;
    } else if (number == 'D') {
        editor.metric = editor.metric == Metric::geodesic ? Metric::euclidean : Metric::geodesic;
        editor.settings_changed();
    } else if (number == 'T') {
        camera.trackball = !camera.trackball;
    } else if (number == key_of("F2")) {
        view.facts = !view.facts;
    } else if (number == key_of("F1")) {
        view.help = !view.help;
    } else if (number == key_of("tab")) {
        view.panels = !view.panels;
    }
}

} // namespace anvil
