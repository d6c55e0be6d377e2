// The viewer without its window: what events, panels and scripts do, and what is to be drawn.
#pragma once

#include "app/viewer/disposer.h"
#include "app/viewer/edit_options.h"
#include "app/viewer/editor.h"
#include "app/viewer/health_check.h"
#include "app/viewer/line_tool.h"
#include "app/viewer/mirror_plane.h"
#include "app/viewer/navigation.h"
#include "app/viewer/occluder_tool.h"
#include "app/viewer/scene.h"
#include "app/viewer/select_tool.h"
#include "app/viewer/workbench.h"
#include "app/viewer/worker.h"
#include "engine/document/recent_files.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace anvil {

/// How things are drawn.
struct ViewSettings {
    Lights lights = Lights::studio;
    bool less_in_motion = false; ///< fewer triangles while the camera moves
    bool flat = false;
    bool edges = false;
    bool tint = true;
    bool contours = true;
    bool occluders = true;
    bool help = false;
    bool panels = true;
    bool facts = false; ///< the mesh's health, times, device
};

/// A sentence for the person at the window.
struct Notice {
    bool is_error = false;
    std::string text;
};

/// A mesh that a recipe names and that is not there.
struct MissingFile {
    std::string text;
    std::filesystem::path file;
    std::function<void(const std::filesystem::path&)> go_on; ///< with the one that was found
};

class Session {
  public:
    /// `changed` is called, from any thread, when there is something new to draw; `disposer` gets what is no
    /// longer shown. @throws DeviceError
    Session(std::shared_ptr<Device> device, const WorkDevice& choice, Disposer& disposer,
            std::function<void()> changed);
    ~Session();

    Editor editor;
    OccluderTool occluders;
    EditOptions options; ///< after a change: options_changed()
    OrbitCamera camera;
    Navigation navigation;
    ViewSettings view;
    SelectTool select;
    LineTool line;

    /// What no panel took.
    void handle(const InputEvent& event);
    /// Once a frame: hands on what the editor wants, takes up what the worker has done.
    void update();

    // What a person can ask for.
    void open(const std::filesystem::path& file, const std::filesystem::path& mesh = {});
    /// The youngest of the sessions that died.
    void recover();
    /// A certain one; `mesh`, if given, stands in for its mesh.
    void recover(const std::shared_ptr<LostSession>& lost, const std::filesystem::path& mesh = {});
    void forget_lost();                           ///< for good
    void leave_lost() { lost_.clear(); }          ///< the next start asks again
    void save(const std::filesystem::path& file); ///< .json: the recipe, else the mesh
    /// A mesh was not found: the dialog that asks for it, or a script, says where it is.
    const std::optional<MissingFile>& missing_mesh() const { return missing_mesh_; }
    void take_missing_mesh(const std::filesystem::path& mesh);
    void leave_missing_mesh() { missing_mesh_.reset(); }
    /// A file that was dropped and waits for what becomes of unsaved changes.
    std::optional<std::filesystem::path> take_wanted_file();
    void want_file(const std::filesystem::path& file) { wanted_file_ = file; }
    /// What the next session takes over from this one where the device that draws is lost; nullptr: nothing.
    std::shared_ptr<LostSession> left_behind() const;
    void lose_computing(); ///< for scripts: as if the device that deforms were lost
    void undo();
    void redo();
    void commit();
    void drop();
    void options_changed();
    /// There is something to take: handles, or a hammer's motion.
    bool has_pending() const;
    /// The edit under way moves something.
    bool moves() const;
    /// No file has all of what is there: the recipe, and the edit under way if it moves something.
    bool unsaved() const { return shown_->document.unsaved || moves(); }
    /// The edit as it would be taken.
    Edit pending() const;
    /// One line: what goes on and which keys matter now.
    std::string hint() const;
    void cancel_work() { worker_->cancel(); }
    void use_device(const std::string& choice);
    /// Another recipe, as one step; `merge` as Document::change().
    void change(const Recipe& next, const std::string& what, const std::string& merge = {});
    void frame_all();
    /// An occluder that is off is left out of the edit under way and the next ones. One step.
    void switch_occluder(const std::string& name, bool on);
    /// What is selected, else the region of the edit, else all.
    void frame_selection();
    // Of what is selected.
    void change_selection(const SelectionChange& change);
    void change_selection(SelectionChange::Kind kind);
    void pin_selection();    ///< for this and all further edits
    void anchor_selection(); ///< of the active handle
    void look_from(const Vec3& direction);
    void set_up(UpAxis up) { camera.set_up(up); }

    const Shown& shown() const { return *shown_; }
    Scene scene() const;
    bool in_motion() const; ///< the camera moves
    /// Nothing is under way and all that was asked for is shown.
    bool settled() const;
    WorkerState work() const { return worker_->state(); }
    const std::vector<Notice>& notices() const { return notices_; }
    void complain(const std::string& text) { notices_.push_back({true, text}); }
    void tell(const std::string& text) { notices_.push_back({false, text}); }
    void dismiss_notices() { notices_.clear(); }
    const std::vector<std::filesystem::path>& recent() const { return recent_; }
    void look_for_recent() { recent_ = recent_files_.list(); } ///< some may be gone meanwhile
    const std::vector<std::shared_ptr<LostSession>>& lost() const { return lost_; }
    const std::vector<std::string>& device_choices() const { return device_choices_; }
    const std::string& driver_of(size_t choice) const { return drivers_[choice]; }
    const MeshHealth* health() { return health_.result(); } ///< of the file's mesh; nullptr: not known yet
    std::optional<Vec3> under_cursor() const;
    /// Of the whole surface, drag and occluders left out.
    Box bounds() const;

  private:
    void key(const InputEvent& event);
    bool handle_selection(const InputEvent& event);
    bool handle_line(const InputEvent& event);
    void trace_line();
    bool command_of_selection(const InputEvent& event);
    void note_missing(const MissingMesh& error, std::function<void(const std::filesystem::path&)> go_on);
    SceneItem surface_item() const;
    bool occluder_key(const InputEvent& event);
    void follow();
    void follow_occluders();
    bool outcome_due() const;
    void look_ahead();
    void move_occluder(const std::string& name);
    void leave_pending();
    std::optional<std::vector<OccluderUse>> uses_now() const;
    Anchors strike_anchor() const;
    void take_up();
    void take_up_document();
    void failed(const std::exception_ptr& error);
    void ask(const std::string& what, Worker::Job job, const std::string& replaces = "");

    std::shared_ptr<Device> device_;
    Disposer& disposer_;
    std::unique_ptr<Workbench> bench_;
    MirrorPlane mirror_plane_;
    std::shared_ptr<const Shown> shown_;
    std::chrono::steady_clock::time_point zoomed_at_;
    size_t opening_ = 0; ///< Shown::opening that the camera was last set for
    std::vector<Notice> notices_;
    std::vector<std::string> device_choices_;
    std::vector<std::string> drivers_; ///< of the choices
    std::optional<MissingFile> missing_mesh_;
    std::optional<std::filesystem::path> wanted_file_;
    std::shared_ptr<const Mesh> examined_; ///< what health_ is of
    HealthCheck health_;
    RecentFiles recent_files_;
    std::vector<std::filesystem::path> recent_;      ///< the last one first
    std::vector<std::shared_ptr<LostSession>> lost_; ///< the youngest first
    mutable std::mutex mutex_;                       ///< of what the worker says
    std::vector<Notice> said_;
    std::optional<MissingFile> said_missing_;
    std::optional<PickedLine> traced_;                  ///< with its path
    std::vector<SurfaceAddress> asked_for_;             ///< the line that was traced last
    std::chrono::steady_clock::time_point followed_at_; ///< when the edit under way changed last
    bool looked_ahead_ = true;                          ///< since then
    std::atomic<bool> refused_ = false;                 ///< the edit under way, as it was followed last
    std::unique_ptr<Worker> worker_;                    ///< last: it uses all else
};

} // namespace anvil
