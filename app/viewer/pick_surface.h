// The surface under the cursor.
#pragma once

#include "app/viewer/orbit_camera.h"
#include "engine/edit/face_address.h"
#include "engine/mesh/search_tree.h"
#include "engine/refine/refined_places.h"

#include <memory>
#include <optional>
#include <span>

namespace anvil {

/// A place that was pointed at, on the surface as it is and as a recipe writes it.
struct SurfaceHit {
    FaceAddress address;
    SurfacePoint point;
    Vec3 position{0};
    Vec3 normal{0}; ///< of the triangle, towards its front; zero where it has no area
};

class PickSurface {
  public:
    /// `mesh` as refinement left it, with the history that led there, at `positions`; all outlive this.
    /// O(t log t).
    PickSurface(const Mesh& mesh, const RefinementHistory& history, std::span<const Vec3> positions);

    /// The same without some faces: with these triangles of the mesh alone.
    PickSurface(const Mesh& mesh, const RefinementHistory& history, std::span<const Vec3> positions,
                std::vector<uint32_t> triangles);

    std::optional<SurfaceHit> hit(const Ray& ray) const;
    /// Its triangle is one of the mesh's; the distance is in lengths of the ray's direction.
    ClosestPoint first_hit(const Ray& ray) const;
    SurfaceHit at(const SurfacePoint& point) const;
    /// Where an address is now; nothing if it is none of this mesh's.
    std::optional<Vec3> position(const SurfaceAddress& address) const;

    std::span<const Vec3> positions() const { return positions_; }
    const Mesh& mesh() const { return mesh_; }

  private:
    ClosestPoint of_mesh(ClosestPoint found) const;

    const Mesh& mesh_;
    const RefinementHistory& history_;
    std::span<const Vec3> positions_;
    std::vector<uint32_t> numbers_; ///< of the tree's triangles in the mesh; empty: all, in order
    SearchTree tree_;
};

} // namespace anvil
