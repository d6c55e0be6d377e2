// What exact windows need of a surface beyond its side lengths.
#pragma once

#include "engine/distance/triangle_graph.h"
#include "engine/distance/unfold.h"

namespace anvil {

/// Triangles laid out over each of their sides, and where shortest paths can bend.
struct WindowTable {
    /// Paths bend at saddles (more than 2 pi around them), at boundaries, and wherever the faces around a
    /// vertex are not one fan.
    enum class Bend : uint8_t { never, saddle, boundary, anywhere };

    std::vector<PlanePoint> apex; ///< per side: the third corner, the side along +x from the origin
    std::vector<double> angle;    ///< per side: of the corner that it leaves
    std::vector<Bend> bend;       ///< per vertex
    std::vector<double> total;    ///< per vertex: sum of its corner angles
    double mean_length = 0;
};

WindowTable make_window_table(const TriangleGraph& graph);

} // namespace anvil
