// The triangles around each vertex in turn, laid out for a front that passes once.
#pragma once

#include "engine/distance/intrinsic_delaunay.h"
#include "engine/distance/triangle_graph.h"

namespace anvil {

/// One edge at a vertex, and the corner counterclockwise of it. Floats: marching errs by far more.
struct Spoke {
    uint32_t vertex = 0; ///< at the other end
    float length = 0;    ///< units of the graph
    float direction = 0; ///< of this edge at this vertex
    float back = 0;      ///< of this edge at the other vertex
    float cosine = 1;    ///< of the corner to the next spoke of the fan
    float sine = 0;      ///< of the same corner; `no_corner` if the fan ends here
    static constexpr float no_corner = -1;
};

/// What a vertex is for fronts that pass it.
struct Fan {
    /// Sum of the corner angles where the corners close around the vertex. `open` where they are one fan with
    /// two ends, `tangled` where they are not one fan: such a vertex is always a source of its own. Both are
    /// so large that directions never wrap around.
    float total = tangled;
    uint32_t first_spoke = 0;
    static constexpr float open = 1e9F;
    static constexpr float tangled = 2e9F;
};

/// Spokes of vertex v: [fans[v].first_spoke, fans[v + 1].first_spoke), counterclockwise. In a closed fan the
/// corner of the last spoke leads to the first. A tangled vertex has each corner as two spokes.
struct FanTable {
    std::vector<Fan> fans; ///< one more than vertices
    std::vector<Spoke> spokes;
    double mean_length = 0;
    double longest = 0;
};

/// Sets the lengths from the spokes.
void sum_lengths(FanTable& table);

/// `origins` give the direction 0 of closed fans; open ones count from their clockwise end.
FanTable make_fan_table(const IntrinsicGraph& graph, std::span<const DirectionOrigin> origins);

/// Angle of the corner that `side` leaves; 0 where a side next to it has no length.
double corner_angle(const TriangleGraph& graph, uint32_t side);

/// Where the fan of a vertex starts and whether it closes.
struct FanShape {
    enum class Kind { closed, open, tangled } kind = Kind::tangled;
    uint32_t first =
        no_index; ///< leaving side: the wished one of a closed fan, the clockwise end of an open one
};
FanShape fan_shape(const TriangleLinks& graph, uint32_t vertex, uint32_t wished_first);

} // namespace anvil
