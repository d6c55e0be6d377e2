// What of the surface is selected, hidden, drawn and picked.
#pragma once

#include "app/viewer/drawn_mesh.h"
#include "app/viewer/pick_surface.h"
#include "app/viewer/select_tool.h"
#include "engine/forge/surface_version.h"

#include <memory>

namespace anvil {

/// One state; never changed.
struct SurfaceLook {
    Selection selection;
    std::shared_ptr<const Buffer> selected;      ///< for SceneItem::selected
    std::shared_ptr<const DrawnIndices> indices; ///< without hidden faces; nullptr: none is hidden
    std::shared_ptr<const DrawnIndices> coarse;  ///< fewer triangles, to draw in motion; nullptr: none made
    std::shared_ptr<const PickSurface> pick;     ///< what is not hidden; nullptr: there is no surface
    size_t selected_count = 0;
    size_t hidden_count = 0;
};

/// Keeps the look of a surface that is edited. For the worker's thread; looks are for any.
class SurfaceLooks {
  public:
    explicit SurfaceLooks(DeviceState& device) : device_(device) {}

    /// The surface after an edit; of another file: nothing is selected or hidden. O(t log t).
    /// @throws DeviceError; the look stays as it was
    void follow(std::shared_ptr<const SurfaceVersion> surface);
    /// @throws DeviceError; the look stays as it was
    void change(const SelectionChange& change);
    /// Adds `coarse` where it is worth it and missing. O(t).
    void add_coarse();

    const std::shared_ptr<const SurfaceLook>& look() const { return look_; }

  private:
    void apply(const SelectionChange& change, Selection& selection) const;
    void show(Selection selection);
    void leave_out_hidden(SurfaceLook& look) const;

    DeviceState& device_;
    std::shared_ptr<const SurfaceVersion> surface_;
    std::shared_ptr<const PickSurface> whole_;
    std::shared_ptr<const Mesh> looked_at_; ///< that the look's indices are of
    std::shared_ptr<const SurfaceLook> look_ = std::make_shared<SurfaceLook>();
};

} // namespace anvil
