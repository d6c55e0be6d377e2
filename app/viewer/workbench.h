// What the viewer works on beside the window: the document and the drag under way. For the worker's thread;
// what it shows can be looked at from any.
#pragma once

#include "app/viewer/live_contact.h"
#include "app/viewer/pick_surface.h"
#include "app/viewer/shown_occluder.h"
#include "app/viewer/surface_look.h"
#include "engine/document/autosave.h"
#include "engine/document/document.h"
#include "engine/forge/drag_session.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/occluder/occluder_set.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace anvil {

/// What a drag touches, and the volume (signed, as enclosed_volume()) of a closed mesh before and after it.
struct DragContact {
    LiveContact touching;
    std::optional<std::array<double, 2>> volume;
};

/// How a drag stands.
struct DragView {
    Edit edit;
    std::vector<Vec3> starts; ///< of the handles
    std::vector<Vec3> ends;   ///< where they are: not always where they are wanted, past an occluder
    size_t region = 0;        ///< vertices
    double condition = 1;
    double milliseconds = 0;            ///< of the last update
    std::optional<DragContact> contact; ///< not measured yet: empty
};

/// What an edit would make if it were taken: with refinement and dilation, which a drag leaves out.
struct Outcome {
    EditReport report;
    size_t vertices = 0; ///< of the mesh then
    std::shared_ptr<DrawnMesh> mesh;
};

/// One state of the workbench; never changed once it is shown.
struct Shown {
    std::shared_ptr<DrawnMesh> mesh;         ///< nullptr: nothing is open
    size_t opening = 0;                      ///< how many documents have been opened: 1 is the first
    std::shared_ptr<const PickSurface> pick; ///< what of it is not hidden
    std::shared_ptr<const SurfaceLook> look = std::make_shared<SurfaceLook>();
    std::shared_ptr<const DrawnRegion> region;
    DocumentState document;
    std::filesystem::path recipe_file; ///< empty: not saved yet
    std::filesystem::path mesh_file;
    std::vector<OccluderView> occluders;
    std::optional<DragView> drag;
    std::optional<Outcome> outcome;      ///< of the drag, once it is known
    std::optional<LiveContact> standing; ///< of the surface as it is, while an occluder is moved
    std::string device;
    std::string driver;
};

/// What deforms, and where distance fields are baked then.
struct WorkDevice {
    std::string choice = "auto"; ///< as of Workbench::use_device()
    DeviceBaking baking = DeviceBaking::on_gpus;
};

class Workbench {
  public:
    /// `device` draws; the same deforms, unless `work` or use_device() says otherwise. @throws DeviceError;
    /// InputError where it is to bake and none deforms
    Workbench(std::shared_ptr<Device> device, const WorkDevice& work);
    ~Workbench();

    std::shared_ptr<const Shown> shown() const;
    /// Warnings since the last call.
    std::vector<std::string> take_warnings();

    void open(const std::filesystem::path& file, const std::filesystem::path& mesh, Progress& progress);
    /// What a session that died has left; it is this one's then.
    void recover(LostSession& lost, const std::filesystem::path& mesh, Progress& progress);
    /// `auto`, `cpu`, a device's name or index. The edit under way goes on with it.
    void use_device(const std::string& choice, Progress& progress);

    /// Shows the edit at the end of the recipe, without taking it. @throws InputError: the one before stays
    void preview(const Edit& edit, Progress& progress);
    void drop_preview();
    /// Shows all that the edit would make. Taking it costs little then. @throws InputError, Cancelled
    void look_ahead(const Edit& edit, Progress& progress);
    /// What the drag touches, if preview() has left it out since it takes long.
    void measure_contact();
    /// What of the surface as it is touches the occluders that the edit uses.
    void touch(const Edit& uses);
    /// Takes the edit into the recipe. It is dropped if that fails.
    void commit(const Edit& edit, const std::string& what, Progress& progress);
    /// Takes another recipe: occluders, past edits.
    void change(const Recipe& next, const std::string& what, const std::string& merge, Progress& progress);
    /// Which occluders are off, as Document::switch_off().
    void switch_off(const std::set<std::string>& names, const std::string& what, Progress& progress);
    void select(const SelectionChange& change);
    /// The way along the surface through these points. @throws InputError where there is none
    std::vector<Vec3> trace(const std::vector<SurfaceAddress>& points);
    /// From now on each call of the device that deforms fails.
    void lose_computing();
    void undo(Progress& progress);
    void redo(Progress& progress);

    void save_recipe(const std::filesystem::path& file);
    void save_mesh(const std::filesystem::path& file);

  private:
    EditWork work(Progress& progress) { return {*backend_, log_, progress}; }
    Document& document();
    DragScene& scene();
    /// Does the step; where the device fails, the CPU takes its place for good and does it again.
    void outlasting(Progress& progress, const std::function<void()>& step);
    void take_document(std::unique_ptr<Document> opened, Progress& progress);
    DocumentOptions document_options() const;
    void make_occluders(Progress& progress);
    void show_document(Progress& progress);
    void show_look();
    void refuse_ill_conditioned_edits(const Recipe& next, Progress& progress);
    void show_drag(double milliseconds);
    std::optional<DragContact> drag_contact(std::span<const Vec3> ends, bool whatever_it_takes);
    std::shared_ptr<const DrawnRegion> drawn_region();
    void publish(const Shown& next);

    std::shared_ptr<Device> device_; ///< that draws
    DeviceBaking baking_;
    Log log_;
    std::shared_ptr<Backend> backend_; ///< that deforms
    std::optional<FileCache> fields_;  ///< baked ones, between runs
    Autosave autosave_;
    std::unique_ptr<Document> document_;
    size_t opening_ = 0;
    std::shared_ptr<const SurfaceVersion> surface_; ///< that `scene_` is of
    SurfaceLooks looks_;
    std::unique_ptr<DragScene> scene_;
    std::shared_ptr<const Recipe> recipe_; ///< that `occluders_` are of
    std::optional<EditOccluders> occluders_;
    std::unique_ptr<DragSession> session_;
    Edit previewed_;          ///< what session_ was given last: one side of a mirrored one
    size_t regions_seen_ = 0; ///< of the session's work: what the last region was made of
    size_t shapes_seen_ = 0;
    std::shared_ptr<Buffer> marks_;
    SplitTriangles split_; ///< of the region
    std::map<std::string, std::pair<OccluderShape, OccluderView>> occluder_views_;
    std::optional<ContactProbe> probe_; ///< of the drag's region
    size_t probed_region_ = 0;
    double contact_seconds_ = 0;        ///< that the last one took
    std::optional<ContactProbe> whole_; ///< of the surface

    mutable std::mutex mutex_; ///< of what follows
    std::shared_ptr<const Shown> shown_;
    std::vector<std::string> warnings_;
};

} // namespace anvil
