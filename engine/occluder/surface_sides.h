// The winding number from the nearest face alone, where the surface is sound.
#pragma once

#include "engine/core/types.h"
#include "engine/mesh/search_tree.h"
#include "engine/occluder/self_intersection.h"
#include "engine/occluder/winding_number.h"

#include <optional>
#include <span>
#include <vector>

namespace anvil {

/// Of a closed surface the winding number is a whole number and changes only across faces, by one. Nothing
/// lies between a point and the surface point closest to it, so the side of that face tells: a component's
/// number is measured once. Which side, at edges and corners: pseudo-normals (Baerentzen and Aanaes 2005).
/// Where faces cross, edges have other than two faces of one orientation or fans meet in a vertex, and
/// everywhere on open surfaces, it does not tell.
class SurfaceSides {
  public:
    /// Vertices at equal positions count as one.
    SurfaceSides(std::span<const Vec3> positions, std::span<const Triangle> triangles, const SearchTree& tree,
                 const WindingNumber& winding);

    /// Winding number at p, `closest` being the surface's closest point to it.
    std::optional<int> winding(const Vec3& p, const ClosestPoint& closest) const;

    bool closed() const { return closed_; }
    size_t crossing_triangles() const { return crossing_; }

  private:
    static constexpr int unknown = 1 << 20;

    void join_edges();
    void find_components(const WindingNumber& winding);
    int measured_front(const std::vector<uint32_t>& component, const WindingNumber& winding) const;
    void find_vertex_normals();
    bool fan_is_whole(uint32_t first_triangle, uint32_t vertex, size_t count) const;
    std::optional<Vec3> normal_at(const ClosestPoint& closest) const;

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;  ///< of the lowest equal vertices
    std::vector<Vec3> normals_;        ///< of the triangles, unit; zero without area
    std::vector<uint32_t> neighbours_; ///< across edge i of triangle t, from corner i to i + 1, at 3t + i
    std::vector<bool> sound_;          ///< triangles
    std::vector<int> front_;           ///< winding number before each triangle, or unknown
    std::vector<Vec3> vertex_normals_; ///< zero where they do not tell
    bool closed_ = true;
    size_t crossing_ = 0;
};

} // namespace anvil
