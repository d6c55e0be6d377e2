// A mesh that is dragged at: all that outlasts one drag.
#pragma once

#include "engine/forge/edit_input.h"
#include "engine/forge/surface_state.h"
#include "engine/forge/surface_version.h"
#include "engine/mesh/incidence.h"
#include "engine/mesh/vertex_numbers.h"

#include <span>

namespace anvil {

class DragScene {
  public:
    /// The mesh at these positions (world), which earlier edits left; both must outlive this unchanged, as
    /// must `history`, what refinement made of the file's mesh until it is this one. `solvers` of the mesh
    /// outlive it too, so that the next scene measures without preparing all anew; `number` as in
    /// EditedSurface. O(mesh).
    DragScene(const Mesh& mesh, std::span<const Vec3> positions, const RefinementHistory& history,
              KeptSolvers& solvers, uint64_t number = new_surface_number());
    /// The version outlives this.
    DragScene(const SurfaceVersion& version, KeptSolvers& solvers)
        : DragScene(*version.mesh, version.positions, *version.history, solvers, version.number) {}

    /// Prepares distances along the surface now, O(mesh), which the first drag would do else.
    void warm();

    const Mesh& mesh() const { return mesh_; }
    std::span<const Vec3> positions() const { return positions_; }
    const Incidence& incidence() const { return incidence_; }
    SurfaceState& surface() { return surface_; }
    VertexNumbers& numbers() { return numbers_; }

    const LocalFrame& frame() const { return frame_; } ///< as forge() has it

  private:
    const Mesh& mesh_;
    std::span<const Vec3> positions_;
    SurfaceState surface_;
    Incidence incidence_;
    VertexNumbers numbers_;
    LocalFrame frame_;
};

} // namespace anvil
