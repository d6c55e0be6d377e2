#include "engine/document/document.h"

#include "engine/core/atomic_file.h"
#include "engine/document/recipe_paths.h"
#include "engine/edit/recipe_json.h"
#include "engine/mesh/mesh_format.h"
#include "engine/mesh/mesh_reader.h"

#include <algorithm>

namespace anvil {

namespace fs = std::filesystem;

namespace {

bool is_recipe(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension == ".json";
}

std::shared_ptr<const Mesh> mesh_of(const Recipe& recipe, Log& log) {
    std::error_code ignored;
    if (!fs::exists(recipe.mesh, ignored)) {
        throw MissingMesh(recipe.file, recipe.mesh);
    }
    return std::make_shared<const Mesh>(read_mesh(recipe.mesh, log));
}

fs::path normal(const fs::path& path) {
    return path.empty() ? path : fs::absolute(path).lexically_normal();
}

/// Equal but for where they stand.
bool says_the_same(const Recipe& a, const Recipe& b) {
    return a.mesh == b.mesh && a.occluders == b.occluders && a.edits == b.edits;
}

std::set<std::string> known_of(std::set<std::string> names, const std::vector<Occluder>& occluders) {
    std::erase_if(names, [&](const std::string& name) {
        return std::none_of(occluders.begin(), occluders.end(),
                            [&](const Occluder& o) { return o.name == name; });
    });
    return names;
}

} // namespace

MissingMesh::MissingMesh(const fs::path& recipe, fs::path mesh)
    : InputError((recipe.empty() ? std::string() : recipe.string() + ": ") + "its mesh " + mesh.string() +
                 " is not there; say where it is now"),
      mesh_(std::move(mesh)) {}

std::unique_ptr<Document> Document::open(const fs::path& file, const EditWork& work,
                                         const DocumentOptions& options, const fs::path& mesh) {
    Recipe recipe;
    if (is_recipe(file)) {
        recipe = with_absolute_paths(read_recipe(normal(file)));
    } else {
        recipe.mesh = normal(file).string();
    }
    const Recipe as_read = recipe;
    std::unique_ptr<Document> document = open_unsaved(std::move(recipe), work, options, mesh);
    document->saved_ = as_read;
    return document;
}

std::unique_ptr<Document> Document::open_unsaved(Recipe recipe, const EditWork& work,
                                                 const DocumentOptions& options, const fs::path& mesh) {
    if (!mesh.empty()) {
        recipe.mesh = normal(mesh).string();
    }
    std::shared_ptr<const Mesh> read = mesh_of(recipe, work.log);
    try {
        return std::unique_ptr<Document>(new Document(recipe, std::move(read), work, options));
    } catch (const InputError& error) {
        throw InputError(recipe.file.empty() ? error.what() : recipe.file + ": " + error.what());
    }
}

Document::Document(const Recipe& recipe, std::shared_ptr<const Mesh> mesh, const EditWork& work,
                   const DocumentOptions& options)
    : options_(options), mesh_file_(recipe.mesh), recipe_file_(recipe.file),
      versions_(std::move(mesh), options.budget) {
    steps_.push_back(step_of(recipe, "", ""));
    go_to(0, work);
}

Document::Step Document::step_of(const Recipe& recipe, const std::string& what, const std::string& merge) {
    Step step{what, merge, nullptr, {}, versions_.chain_of(recipe), {}};
    const Step* now = steps_.empty() ? nullptr : &steps_[step_];
    step.occluders = now != nullptr && *now->occluders == recipe.occluders
                         ? now->occluders
                         : std::make_shared<const std::vector<Occluder>>(recipe.occluders);
    for (size_t i = 0; i < recipe.edits.size(); ++i) {
        const bool same = now != nullptr && i < now->edits.size() && *now->edits[i] == recipe.edits[i];
        step.edits.push_back(same ? now->edits[i] : std::make_shared<const Edit>(recipe.edits[i]));
    }
    if (now != nullptr) {
        step.off = known_of(now->off, recipe.occluders);
    }
    return step;
}

std::shared_ptr<const Recipe> Document::recipe_of(const Step& step) const {
    Recipe recipe;
    recipe.file = recipe_file_.string();
    recipe.mesh = mesh_file_.string();
    recipe.occluders = *step.occluders;
    for (const auto& edit : step.edits) {
        recipe.edits.push_back(*edit);
    }
    return std::make_shared<const Recipe>(std::move(recipe));
}

/// The surface first: if that throws, nothing has changed.
void Document::go_to(size_t step, const EditWork& work) {
    std::shared_ptr<const Recipe> recipe = recipe_of(steps_[step]);
    const EditOccluders occluders = this->occluders(*recipe, work);
    surface_ = versions_.version(steps_[step].chain, recipe->edits.size(), occluders, work);
    recipe_ = std::move(recipe);
    step_ = step;
}

EditOccluders Document::occluders(const Recipe& recipe, const EditWork& work) {
    return {recipe, work.log, work.progress, options_.fields, &models_, work.backend.search_device()};
}

std::shared_ptr<const SurfaceVersion> Document::surface_before(size_t index, const EditWork& work) {
    const VersionStore::Chain& chain = steps_[step_].chain;
    if (index >= chain.size()) {
        throw InternalError("there is no edit " + std::to_string(index) + " to start from");
    }
    const EditOccluders occluders = this->occluders(*recipe_, work);
    return versions_.version(chain, index, occluders, work);
}

DocumentState Document::state() const {
    return {recipe_,
            surface_,
            can_undo() ? steps_[step_].what : std::string(),
            can_redo() ? steps_[step_ + 1].what : std::string(),
            unsaved(),
            steps_[step_].off};
}

/// What is applied is what a file of it says.
Recipe Document::checked(const Recipe& next) const {
    const std::string name = (recipe_file_.empty() ? mesh_file_ : recipe_file_).string();
    return parse_recipe(write_recipe(next), name);
}

std::vector<std::shared_ptr<const SurfaceVersion>> Document::foresee(const Recipe& next,
                                                                     const EditWork& work) {
    const Recipe recipe = this->checked(next);
    VersionStore::Chain chain = versions_.chain_of(recipe);
    const EditOccluders occluders = this->occluders(recipe, work);
    const auto last = versions_.version(chain, recipe.edits.size(), occluders, work);
    std::vector<std::shared_ptr<const SurfaceVersion>> made;
    for (size_t i = 0; i < chain.size(); ++i) {
        made.push_back(VersionStore::version_at_hand(chain, i));
    }
    made.back() = last;
    foreseen_ = std::move(chain);
    return made;
}

void Document::change(const Recipe& next, const std::string& what, const EditWork& work,
                      const std::string& merge) {
    Recipe checked = this->checked(next);
    if (says_the_same(checked, *recipe_)) {
        return;
    }
    if (checked.mesh != mesh_file_) {
        throw InternalError("a step cannot change the mesh; open the recipe with another one");
    }
    const bool merges = !merge.empty() && step_ > 0 && !can_redo() && steps_[step_].merge == merge;
    Step step = step_of(checked, merges ? steps_[step_].what : what, merge);
    const EditOccluders occluders = this->occluders(checked, work);
    std::shared_ptr<const SurfaceVersion> surface =
        versions_.version(step.chain, checked.edits.size(), occluders, work);

    step_ += merges ? 0 : 1;
    steps_.resize(step_);
    steps_.push_back(std::move(step));
    checked.file = recipe_file_.string();
    recipe_ = std::make_shared<const Recipe>(std::move(checked));
    surface_ = std::move(surface);
    foreseen_.clear(); // what of it was taken has places of its own
    keep_models();
}

void Document::switch_off(std::set<std::string> names, const std::string& what) {
    Step step = steps_[step_];
    step.off = known_of(std::move(names), *step.occluders);
    if (step.off == steps_[step_].off) {
        return;
    }
    step.what = what;
    step.merge.clear();
    steps_.resize(++step_);
    steps_.push_back(std::move(step));
    keep_models();
}

/// Models of occluders that no step has any more would only take memory.
void Document::keep_models() {
    std::vector<const Occluder*> used;
    for (const Step& step : steps_) {
        for (const Occluder& occluder : *step.occluders) {
            used.push_back(&occluder);
        }
    }
    models_.drop_all_but(used);
}

void Document::undo(const EditWork& work) {
    if (can_undo()) {
        go_to(step_ - 1, work);
    }
}

void Document::redo(const EditWork& work) {
    if (can_redo()) {
        go_to(step_ + 1, work);
    }
}

void Document::change_backend(const EditWork& work) {
    go_to(step_, work);
}

bool Document::unsaved() const {
    return !saved_ || !says_the_same(*saved_, *recipe_);
}

void Document::check_target(const fs::path& file) const {
    if (reads(*recipe_, file)) {
        throw InputError(file.string() + " would overwrite what the recipe reads; name another file");
    }
}

void Document::save_recipe(const fs::path& file) {
    check_target(file);
    const fs::path target = normal(file);
    write_file_atomically(target, write_recipe(with_paths_from(*recipe_, target.parent_path())));
    recipe_file_ = target;
    Recipe saved = *recipe_;
    saved.file = target.string();
    steps_[step_].merge.clear();
    recipe_ = std::make_shared<const Recipe>(saved);
    saved_ = std::move(saved);
}

void Document::save_mesh(const fs::path& file, OutputPrecision precision) const {
    mesh_format(file);
    check_target(file);
    if (!recipe_file_.empty() && same_file(file, recipe_file_)) {
        throw InputError(file.string() + " would overwrite the recipe; name another file");
    }
    write_edited_mesh(file, *surface_->mesh, surface_->positions, surface_->moved, precision);
}

Edit with_poses(const Recipe& recipe, Edit edit) {
    edit.occluders = occluders_of(recipe, edit);
    return edit;
}

} // namespace anvil
