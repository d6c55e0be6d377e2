// Places on a triangle found again after the triangle was divided.
#pragma once

#include "engine/mesh/surface_point.h"
#include "engine/refine/refined_mesh.h"

#include <unordered_map>

namespace anvil {

/// Weights of vertices in one triangle `root` that was divided; `parents` of the vertices from number
/// `first` on.
class RootPlaces {
  public:
    RootPlaces(const Triangle& root, size_t first, std::span<const VertexParents> parents);

    /// Barycentrics in the root of a vertex of one of its parts.
    Vec3 weights_of(uint32_t vertex);

    /// Barycentrics within the part `corners` of the place with these barycentrics in the root; one is
    /// negative if the place is elsewhere.
    Vec3 within(const Triangle& corners, const Vec3& weights);

  private:
    size_t first_;
    std::span<const VertexParents> parents_;
    std::unordered_map<uint32_t, Vec3> known_;
};

/// What became of a mesh's triangles and vertices over any number of refinements, so that addresses of the
/// file keep their places.
class RefinementHistory {
  public:
    /// `mesh`: before any refinement; must outlive this.
    explicit RefinementHistory(const Mesh& mesh) : mesh_(mesh) {}

    /// After the current mesh was refined.
    void add(const RefinedMesh& refined);

    const Mesh& first_mesh() const { return mesh_; }
    /// Of all vertices added so far.
    const std::vector<VertexParents>& parents() const { return parents_; }
    /// Per current triangle: the triangle of the mesh before any refinement that it is or is part of; empty:
    /// each is itself.
    const std::vector<uint32_t>& roots() const { return roots_; }

    /// The point of the current mesh (with these triangles) at barycentrics of a triangle of the mesh before
    /// any refinement.
    SurfacePoint find(std::span<const Triangle> triangles, uint32_t first_triangle,
                      const Vec3& weights) const;

    /// The other way: the point of the mesh before any refinement that became this one of a current triangle.
    SurfacePoint find_first(std::span<const Triangle> triangles, const SurfacePoint& point) const;

    /// The current triangles that the triangles [first, end) of the mesh before any refinement became.
    std::vector<uint32_t> parts_of(uint32_t first, uint32_t end) const;

  private:
    const Mesh& mesh_;
    std::vector<VertexParents> parents_;
    std::vector<uint32_t> roots_;
};

} // namespace anvil
