// What touches the occluders while something is dragged: how much, how deep, and where.
#pragma once

#include "engine/mesh/incidence.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/occluder_set.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace anvil {

/// A place and how deep it is in an occluder; negative: how far outside of it.
struct DeepPlace {
    Vec3 position{0};
    double depth = 0;
};

struct LiveContact {
    size_t vertices = 0;                     ///< that touch an occluder or are inside
    size_t triangles = 0;                    ///< the same, in one of 15 places at least
    std::optional<DeepPlace> vertex;         ///< the deepest of those
    std::optional<DeepPlace> triangle;       ///< the deepest, by its centre; only where one dips in
    std::vector<Vec3> marks;                 ///< some of the vertices
    std::vector<std::array<Vec3, 3>> facets; ///< some of the triangles
};

/// A part of a mesh that moves, with the triangles around it. O(part) to make and to ask.
class ContactProbe {
  public:
    /// `at_rest`: places (world) of the whole mesh; `moving`: its vertices that move, each once.
    ContactProbe(std::span<const Triangle> triangles, const Incidence& incidence,
                 std::span<const Vec3> at_rest, std::span<const uint32_t> moving);

    /// `set` as it stands at the end, relative to `origin`; `ends`: places (world) of what moves.
    LiveContact measure(const OccluderSet& set, const Vec3& origin, std::span<const Vec3> ends) const;

    /// By how much the volume of a closed mesh grows, in the sign of enclosed_volume().
    double volume_change(std::span<const Vec3> ends) const;

  private:
    std::vector<Vec3> places(std::span<const Vec3> ends) const;

    size_t moving_;
    std::vector<Vec3> at_rest_; ///< what moves first, then the other corners
    std::vector<Triangle> triangles_;
};

} // namespace anvil
