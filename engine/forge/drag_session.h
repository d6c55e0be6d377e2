// One edit while it is dragged: what does not change stays where it is computed.
#pragma once

#include "engine/deform/lasting_backend.h"
#include "engine/forge/drag_scene.h"
#include "engine/forge/edit_motion.h"
#include "engine/forge/edit_occluders.h"
#include "engine/forge/kept_marches.h"
#include "engine/forge/region_fans.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// How often each stage has been done: what an update did, and what it spared.
struct DragWork {
    size_t distances = 0; ///< asked for along the surface; MarchWork says what of that was new
    size_t regions = 0;   ///< cut out and handed to the back end
    size_t shapes = 0;    ///< handed over alone
    size_t occluders = 0; ///< handed over alone
    size_t updates = 0;   ///< systems solved and submitted
};

/// A new target costs a k x k solve and one submission: the deformation of the region, the normals of the
/// region and the vertices around it. Nothing depends on the mesh's size, nothing is read back unless asked
/// for. Refinement and dilation are the committed edit's: forge() does them. Not for several threads.
class DragSession {
  public:
    /// Measures, uploads, and submits the edit as it stands. Scene and back end must outlive the session;
    /// `occluders` is only read. If the device fails, now or later, the session goes on with the CPU back end
    /// and warns. @throws InputError as forge() does for the edit.
    DragSession(DragScene& scene, const EditOccluders& occluders, Backend& backend, const Edit& edit,
                Log& log);

    /// Submits the edit as it is now; what of it differs from before decides what is done again: targets,
    /// axis, steps and amount cost a step; shapes and `occluders` are handed over anew; a radius not larger
    /// than any before cuts the region anew; a larger one marches on over the surface, as do further handles
    /// and anchors beside those that stay (see KeptMarches); all else measures distances anew.
    /// @throws InputError if a target is out of reach or the edit is wrong; the edit before stands then.
    void update(const Edit& given, const EditOccluders& occluders);

    /// Returns when the last update is done.
    void wait();

    /// The last one; of a mirrored one what it says of both sides.
    const Edit& edit() const { return now_.edit; }
    const EditRegion& region() const { return now_.region; }
    const EditMotion& motion() const { return now_.motion; }
    const DeformInput& input() const { return *now_.input; }
    const DragWork& work() const { return work_; }
    const MarchWork& march_work() const { return marches_.work(); }
    /// The vertices with a normal: the region, then those around it.
    const std::vector<uint32_t>& normal_vertices() const { return now_.normal_vertices; }
    std::string device_name() const { return backend_.device_name(); }
    /// What the region is on now, for drawing; another one after a change of the region. Once the device has
    /// failed it is on none.
    std::shared_ptr<const DeformSession> session() const { return now_.session; }

    // Read back; waits for the last update.

    /// Of the region's vertices, world. Where an occluder is, forge() finishes them by exact distances.
    std::vector<Vec3> positions();
    /// Of `normal_vertices`: unit, or zero where no triangle has area.
    std::vector<Vec3> normals();

  private:
    /// One edit on the device.
    struct Stage {
        Edit edit;
        std::shared_ptr<const EditDistances> measured;
        EditRegion region;
        std::vector<uint32_t> normal_vertices;
        std::shared_ptr<DeformInput> input;
        std::vector<OccluderUse> uses;
        OccluderModels models; ///< of the uses
        EditMotion motion;
        std::shared_ptr<DeformSession> session;
    };

    /// Radii of the edit where the distances measured so far are its own and reach that far.
    std::optional<std::vector<double>> radii_within_measured(const Edit& edit) const;
    Stage opened(const Edit& edit, const EditOccluders& occluders,
                 std::shared_ptr<const EditDistances> measured, const std::vector<double>& radii);
    void change(const Edit& edit, const EditOccluders& occluders);
    OccluderSet set_for(const Edit& edit, const EditOccluders& occluders, const EditRegion& region) const;
    EditMotion motion_of(const Edit& edit, const EditRegion& region, const OccluderSet& set);

    DragScene& scene_;
    KeptMarches marches_;
    LastingBackend backend_;
    Log& log_;
    Stage now_;
    DragWork work_;
};

} // namespace anvil
