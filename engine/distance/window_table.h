// What exact windows need of a surface: each triangle in one place, and where shortest paths can bend.
#pragma once

#include "engine/distance/triangle_graph.h"
#include "engine/distance/unfold.h"

namespace anvil {

struct WindowTable {
    /// Paths bend at saddles (more than 2 pi around them), at boundaries, and wherever the faces around a
    /// vertex are not one fan.
    enum class Bend : uint8_t { never, saddle, boundary, anywhere };

    /// Side k runs from corner k to corner k + 1, as in TriangleGraph.
    struct Face {
        std::array<double, 3> length;
        std::array<PlanePoint, 3> along; ///< at corner k: cosine and sine of its angle
        std::array<uint32_t, 3> vertex;
        /// 8 * the next side of the same edge, + `thin` if its face is, + `more` if there are more than these
        /// two, + `same_way` if it runs the same way; no_index where no other side shares the edge.
        std::array<uint32_t, 3> across;
    };

    static constexpr uint32_t same_way = 1, more = 2, thin = 4;

    std::vector<Face> faces;
    std::vector<double> angle; ///< per side: of the corner that it leaves
    std::vector<Bend> bend;    ///< per vertex
    std::vector<double> total; ///< per vertex: sum of its corner angles
    double mean_length = 0;

    /// The third corner, the side along +x from the origin.
    PlanePoint apex(uint32_t side) const {
        const Face& face = faces[side / 3];
        const PlanePoint& along = face.along[side % 3];
        const double left = face.length[(side + 2) % 3];
        return {left * along.x, left * along.y};
    }
};

WindowTable make_window_table(const TriangleGraph& graph);

/// Brings the table up to date where triangles around these vertices have changed; the others are as before,
/// and keep their numbers.
void update_window_table(WindowTable& table, const TriangleGraph& graph,
                         std::span<const uint32_t> changed_vertices);

} // namespace anvil
