#include "app/viewer/workbench.h"

#include "app/backend_choice.h"
#include "engine/core/error.h"
#include "engine/core/file_cache.h"
#include "engine/core/user_folder.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/occluder/shown_surface.h"

namespace anvil {

namespace {

constexpr int occluder_cells = 64;

} // namespace

Workbench::Workbench(std::shared_ptr<Device> device, const WorkDevice& work)
    : device_(std::move(device)), baking_(work.baking), fields_(user_cache()), autosave_(user_state_folder()),
      looks_(device_->state()), shown_(std::make_shared<const Shown>()) {
    Progress progress;
    use_device(work.choice, progress);
    if (baking_ == DeviceBaking::always) {
        check_baking(baking_, backend_->search_device() != nullptr);
    }
}

Workbench::~Workbench() = default;

std::shared_ptr<const Shown> Workbench::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

std::vector<std::string> Workbench::take_warnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
}

void Workbench::publish(const Shown& next) {
    auto shown = std::make_shared<const Shown>(next); // the one before ends after the lock
    const std::lock_guard lock(mutex_);
    shown_.swap(shown);
    warnings_.insert(warnings_.end(), log_.warnings.begin(), log_.warnings.end());
    log_.warnings.clear();
}

Document& Workbench::document() {
    if (!document_) {
        throw InputError("nothing is open; open a mesh or a recipe first");
    }
    return *document_;
}

void Workbench::use_device(const std::string& choice, Progress& progress) {
    std::string wanted = choice;
    if (choice == "auto") {
        const auto best = automatic_device(devices_or_none(log_));
        wanted = best ? std::to_string(*best) : "cpu";
    }
    std::shared_ptr<Backend> next;
    if (wanted == "cpu") {
        next = make_cpu_backend();
    } else {
        const std::vector<DeviceInfo> devices = list_devices();
        const size_t index = choose_device(devices, wanted);
        const bool same = devices[index].index == device_->info().index;
        // What the drawing device deforms is drawn where it lies.
        next = make_gpu_backend(
            same ? device_ : std::make_shared<Device>(DeviceOptions{.choice = std::to_string(index)}),
            {.baking = baking_,
             .log = choice == "auto" && baking_ != DeviceBaking::always ? nullptr : &log_});
    }
    const std::optional<Edit> dragged = session_ ? std::optional(previewed_) : std::nullopt;
    session_.reset();
    backend_ = std::move(next);
    if (document_) {
        document_->change_backend(work(progress));
        show_document(progress);
        if (dragged) {
            preview(*dragged, progress);
        }
    } else {
        Shown empty;
        empty.device = backend_->device_name();
        publish(empty);
    }
}

void Workbench::open(const std::filesystem::path& file, const std::filesystem::path& mesh,
                     Progress& progress) {
    take_document(Document::open(file, work(progress), document_options(), mesh), progress);
}

void Workbench::recover(LostSession& lost, const std::filesystem::path& mesh, Progress& progress) {
    take_document(Document::open_unsaved(lost.recipe, work(progress), document_options(), mesh), progress);
    lost.discard(); // it is in this session's own file now
}

DocumentOptions Workbench::document_options() const {
    DocumentOptions options;
    options.fields = fields_ ? &*fields_ : nullptr;
    return options;
}

void Workbench::take_document(std::unique_ptr<Document> opened, Progress& progress) {
    drop_preview();
    scene_.reset();
    surface_.reset();
    occluders_.reset();
    recipe_.reset();
    document_ = std::move(opened);
    ++opening_;
    show_document(progress);
}

/// Also what the next drag starts from, so that it starts at once.
void Workbench::show_document(Progress& progress) {
    session_.reset();
    if (document().unsaved()) {
        autosave_.commit(document().recipe(), log_);
    } else {
        autosave_.forget();
    }
    Shown next;
    next.document = document().state();
    next.opening = opening_;
    const std::shared_ptr<const SurfaceVersion>& surface = next.document.surface;
    const std::shared_ptr<const Shown> before = shown();
    const bool same_surface = surface_ == surface && before->mesh;
    next.mesh = same_surface ? before->mesh
                             : std::make_shared<DrawnMesh>(device_->state(), *surface->mesh,
                                                           surface->positions, surface->frame.origin, true);
    if (!same_surface) {
        looks_.follow(surface);
    }
    next.look = looks_.look();
    next.pick = next.look->pick;
    next.recipe_file = document().recipe_file();
    next.mesh_file = document().mesh_file();
    next.device = backend_->device_name();
    next.driver = backend_->driver_name();
    make_occluders(progress);
    for (const Occluder& occluder : recipe_->occluders) {
        next.occluders.push_back(occluder_views_.at(occluder.name).second);
        next.occluders.back().transform = occluder.transform;
    }
    if (!same_surface) {
        scene_.reset();
        whole_.reset();
        surface_ = surface;
    }
    publish(next);
    scene().warm();
    show_look();
}

/// What is looked at in motion comes last: nothing waits for it.
void Workbench::show_look() {
    const auto show = [&] {
        Shown next = *shown();
        next.look = looks_.look();
        next.pick = next.look->pick;
        publish(next);
    };
    if (shown()->look != looks_.look()) {
        show();
    }
    looks_.add_coarse();
    if (shown()->look != looks_.look()) {
        show();
    }
}

std::vector<Vec3> Workbench::trace(const std::vector<SurfaceAddress>& points) {
    SurfaceState& surface = scene().surface();
    std::vector<SurfacePoint> places;
    places.reserve(points.size());
    for (const SurfaceAddress& point : points) {
        places.push_back(surface.resolve(point, "the line"));
    }
    std::vector<Vec3> path;
    for (const SurfacePoint& place : surface.line_through(places, 0, "the line")) {
        path.push_back(surface.position_of(place));
    }
    return path;
}

void Workbench::select(const SelectionChange& change) {
    looks_.change(change);
    show_look();
}

DragScene& Workbench::scene() {
    if (!scene_) {
        scene_ = std::make_unique<DragScene>(*surface_->mesh, surface_->positions, *surface_->history,
                                             document().solvers());
    }
    return *scene_;
}

void Workbench::make_occluders(Progress& progress) {
    recipe_ = document().state().recipe;
    occluders_.emplace(document().occluders(*recipe_, work(progress)));
    std::map<std::string, std::pair<OccluderShape, OccluderView>> views;
    Box scene;
    for (const Vec3& p : document().surface()->positions) {
        scene.include(p);
    }
    for (const Occluder& occluder : recipe_->occluders) {
        const auto known = occluder_views_.find(occluder.name);
        // A plane's patch lies where the scene is.
        const bool is_plane = std::holds_alternative<PlaneShape>(occluder.shape.solid);
        if (known != occluder_views_.end() && known->second.first == occluder.shape && !is_plane) {
            views.insert(*known);
            continue;
        }
        const Mesh surface = shown_surface(occluder.shape, placement(occluder.transform), scene,
                                           {recipe_folder(*recipe_), nullptr}, occluder_cells);
        OccluderView view;
        view.name = occluder.name;
        view.mesh = std::make_shared<DrawnMesh>(device_->state(), surface, surface.positions, Vec3(0), false);
        view.tree = std::make_shared<const SearchTree>(surface.positions, surface.triangles);
        view.pivot = pivot_of(occluder.shape, view.mesh->box);
        views[occluder.name] = {occluder.shape, std::move(view)};
    }
    occluder_views_ = std::move(views);
}

void Workbench::commit(const Edit& edit, const std::string& what, Progress& progress) {
    Recipe next = document().recipe();
    next.edits.push_back(with_poses(next, edit));
    change(next, what, "", progress);
}

void Workbench::change(const Recipe& next, const std::string& what, const std::string& merge,
                       Progress& progress) {
    try {
        outlasting(progress, [&] {
            refuse_ill_conditioned_edits(next, progress);
            document().change(next, what, work(progress), merge);
        });
    } catch (...) {
        drop_preview();
        throw;
    }
    show_document(progress);
}

void Workbench::switch_off(const std::set<std::string>& names, const std::string& what, Progress& progress) {
    document().switch_off(names, what);
    show_document(progress);
}

void Workbench::undo(Progress& progress) {
    outlasting(progress, [&] { document().undo(work(progress)); });
    show_document(progress);
}

void Workbench::redo(Progress& progress) {
    outlasting(progress, [&] { document().redo(work(progress)); });
    show_document(progress);
}

void Workbench::save_recipe(const std::filesystem::path& file) {
    document().save_recipe(file);
    autosave_.forget();
    Shown next = *shown();
    next.document = document().state();
    next.recipe_file = document().recipe_file();
    publish(next);
}

void Workbench::save_mesh(const std::filesystem::path& file) {
    document().save_mesh(file);
}

} // namespace anvil
