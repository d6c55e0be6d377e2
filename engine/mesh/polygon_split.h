// How one polygon becomes triangles; triangulate() applies it to a mesh.
#pragma once

#include "engine/core/types.h"

#include <cstddef>
#include <vector>

namespace anvil {

/// Splits polygons given as points into triangles of corner numbers. Holds its workspace, so that a mesh of
/// many polygons allocates once, and a budget of ear tests: a hostile file of giant polygons gets fans when
/// it is spent.
class PolygonSplitter {
  public:
    /// Triangles (corner numbers, 0-based) of a polygon with n >= 3 points: n - 2 of them, the polygon's own
    /// orientation; valid until the next call. Any finite points, also coincident ones.
    const std::vector<Triangle>& split(const std::vector<Vec3>& points);

  private:
    void split_quad();
    void split_large();
    void project();
    bool strictly_convex() const;
    double turn(uint32_t a, uint32_t b, uint32_t c) const;
    bool is_ear(size_t slot);
    size_t choose_ear(size_t start);
    void clip_ears();

    std::vector<Vec3> points_;        ///< relative to the first one, longest distance about 1
    std::vector<glm::dvec2> flat_;    ///< points_ in the mean plane
    std::vector<uint32_t> remaining_; ///< corners not yet clipped
    std::vector<Triangle> triangles_;
    double budget_ = 2e8;
};

} // namespace anvil
