// What every marching method needs to know of a surface: side lengths and the triangles around each vertex.
#pragma once

#include "engine/distance/numbering.h"
#include "engine/distance/unfold.h"

#include <span>
#include <vector>

namespace anvil {

/// How triangles hang together. Side s = 3 t + k of triangle t runs from its corner k to corner k + 1. A side
/// also stands for the corner that it leaves. Any number of triangles may share an edge or a vertex.
struct TriangleLinks {
    std::vector<uint32_t> corner_vertex; ///< 3 per triangle
    /// The next side of the same edge, in a ring over all of them: 2 * side, + 1 if it runs the same way;
    /// no_index where no other side shares the edge. Triangles with a corner twice are not linked.
    std::vector<uint32_t> across;
    std::vector<uint32_t> leaving_begin; ///< vertex_count() + 1
    std::vector<uint32_t> leaving;       ///< the sides that leave each vertex

    /// What twin() gives in place of a side.
    static constexpr uint32_t boundary = no_index;
    static constexpr uint32_t tangled = no_index - 1;

    size_t vertex_count() const { return leaving_begin.size() - 1; }
    size_t triangle_count() const { return corner_vertex.size() / 3; }
    static uint32_t next(uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
    static uint32_t previous(uint32_t side) { return side % 3 == 0 ? side + 2 : side - 1; }
    /// The side that runs the other way along the same edge, where just two triangles of like orientation
    /// meet; `boundary` where the triangle is alone, `tangled` where it is any other case.
    uint32_t twin(uint32_t side) const {
        const uint32_t link = across[side];
        if (link == no_index) {
            return boundary;
        }
        return (link & 1) == 0 && across[link >> 1] == 2 * side ? link >> 1 : tangled;
    }
    uint32_t from(uint32_t side) const { return corner_vertex[side]; }
    uint32_t to(uint32_t side) const { return corner_vertex[next(side)]; }
    uint32_t apex(uint32_t side) const { return corner_vertex[previous(side)]; }
    std::span<const uint32_t> sides_leaving(uint32_t vertex) const {
        return {leaving.data() + leaving_begin[vertex], leaving.data() + leaving_begin[vertex + 1]};
    }
};

/// A surface as its mesh has it. Vertices and triangles have the numbers of `numbering`; corners keep their
/// order. Lengths are in units of a power of two near the extent of the mesh, so that squares neither
/// overflow nor vanish at any scale and scaling by powers of two changes no digit.
struct TriangleGraph : TriangleLinks {
    Numbering numbering;
    double unit = 1;          ///< world length of 1
    std::vector<Vec3> places; ///< per vertex, in units
    double longest_side = 0;  ///< no side is longer

    double length(uint32_t side) const { return glm::length(places[to(side)] - places[from(side)]); }
};

/// What is measured of a triangle in space: of needles and caps the lengths alone know angles to the root of
/// rounding only.
struct MeasuredTriangle {
    std::array<double, 3> length; ///< of the sides from corners 0, 1, 2
    uint32_t shortest;            ///< of these
    double dot;                   ///< of the shortest side and the one before it turned around
    double double_area;           ///< twice the area

    /// Direction of the third corner as seen from the one that side k leaves, the side along +x; (1, 0) where
    /// two corners coincide.
    PlanePoint direction_of_apex(uint32_t k) const;
};
MeasuredTriangle measured(const TriangleGraph& graph, uint32_t triangle);

/// The same of one corner, by its side.
PlanePoint direction_of_apex(const TriangleGraph& graph, uint32_t side);

/// Lists `leaving` anew from corner_vertex.
void link_vertices(TriangleLinks& graph, size_t vertex_count);

/// One end of an edge: the other vertex, and the side.
struct EdgeSide {
    uint32_t other, side;
};

/// Sets `across` of the edges from `vertex` to higher vertices, from `leaving`. Triangles with a corner twice
/// are passed over. `ends` is kept between calls for its memory alone.
void link_edges_of(TriangleLinks& graph, uint32_t vertex, std::vector<EdgeSide>& ends);

/// Room for some more: tables of meshes that are refined then grow in place. What is not used costs nothing,
/// as it is never touched.
inline size_t with_room(size_t count) {
    return count + count / 8;
}

/// The unit for a surface within the box of these positions.
double unit_of(std::span<const Vec3> positions);

/// Every index of `triangles` is below positions.size(); positions are finite.
TriangleGraph make_triangle_graph(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                                  Numbering numbering);

} // namespace anvil
