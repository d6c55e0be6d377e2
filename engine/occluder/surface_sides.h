// The winding number from the nearest face alone, where the surface is sound.
#pragma once

#include "engine/core/types.h"
#include "engine/mesh/search_tree.h"
#include "engine/occluder/self_intersection.h"
#include "engine/occluder/surface_boundary.h"
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

    /// Has the processor fetch what winding() will ask for, if anything was found.
    void prefetch(const ClosestPoint& closest) const {
        if (closest.found()) {
            __builtin_prefetch(&faces_[slots_[closest.triangle]]);
        }
    }

    bool closed() const { return closed_; }
    /// Whether an edge is that of more than two triangles, or of two that lie the other way round than each
    /// other.
    bool tangled() const { return tangled_; }
    size_t crossing_triangles() const { return crossing_; }
    /// None if closed, and the next time.
    std::vector<BoundaryEdge> take_boundary() { return std::move(boundary_); }

  private:
    static constexpr int unknown = 1 << 20;

    template <class Visit>
    void each_edge(const Visit& visit) const;
    void join_edges();
    void join(uint32_t edge, uint32_t other);
    void find_components(const WindingNumber& winding);
    int measured_front(const std::vector<uint32_t>& component, const WindingNumber& winding) const;
    void find_vertex_normals();
    bool fan_is_whole(uint32_t first_triangle, uint32_t vertex, size_t count) const;

    /// All that is asked of a triangle, side by side, and triangles in the order of the tree: what is asked
    /// for nearby points lies together.
    struct alignas(64) Face {
        Vec3 normal{0};     ///< unit; zero without area
        Triangle corners{}; ///< in positions_
        std::array<uint32_t, 3> neighbours{no_index, no_index,
                                           no_index}; ///< across the edge from corner i on
        int front = unknown;                          ///< winding number before it
        bool sound = true;
    };

    void add_face(const Triangle& t, std::span<const Vec3> positions, std::vector<uint32_t>& numbers,
                  Crossing crossing);
    std::optional<Vec3> normal_at(const Face& face, const Vec3& barycentric) const;

    std::vector<uint32_t> slots_; ///< of the triangles in faces_
    std::vector<Face> faces_;
    std::vector<Vec3> positions_;      ///< no two are equal; as the faces use them
    std::vector<Vec3> vertex_normals_; ///< zero where they do not tell
    bool closed_ = true;
    std::vector<BoundaryEdge> boundary_;
    size_t crossing_ = 0;
    bool tangled_ = false;
};

} // namespace anvil
