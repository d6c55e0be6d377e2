// All that distances need to know of one surface, made once and kept up to date.
#pragma once

#include "engine/distance/fan_table.h"
#include "engine/distance/triangle_graph.h"

namespace anvil {

struct SurfaceTables {
    TriangleGraph graph;          ///< as the mesh has it: sources refer to its triangles
    FanTable fans;                ///< of the same surface cut by intrinsic Delaunay edges
    std::vector<uint8_t> flipped; ///< as in IntrinsicDelaunay, per triangle of `graph`
};

/// Positions are finite, and every index of the triangles is below their count.
SurfaceTables make_surface_tables(std::span<const Triangle> triangles, std::span<const Vec3> positions);

/// What an update did anew.
struct SurfaceChange {
    std::vector<uint32_t> triangles; ///< ascending, of the graph: measured anew
    std::vector<uint32_t> vertices;  ///< ascending: all corners of these, before and now, and what is new
    size_t flipped = 0;              ///< triangles that took part in flips anew, if only to be looked at
    size_t fans = 0;                 ///< vertices that got their spokes anew
};

/// Makes the tables those of a surface that differs in some triangles: divided, or moved. All other numbers
/// of the graph, and the spokes of vertices away from the change, stay as they are; new vertices and
/// triangles follow them. What is as before is found by comparing; the work beyond that and beyond copying is
/// that of the change: of the triangles that changed, those that lie in common Delaunay triangles with them,
/// and two rings around these, so that flips that cross the rim are found.
/// @param roots: per triangle the one before that it is or was part of; empty: each was itself
/// @return false if the surface differs too much; the tables are of no use then and are to be made.
bool update_surface_tables(SurfaceTables& tables, std::span<const Triangle> triangles,
                           std::span<const Vec3> positions, std::span<const uint32_t> roots,
                           SurfaceChange& change);

/// The part of it that brings the Delaunay edges up to date. `tables.graph` is that of the new surface, and
/// `torn` are the triangles that changed and all that were joined with one by flipped sides; their flags in
/// `tables.flipped` are 0. @return false as above.
bool update_fans(SurfaceTables& tables, std::span<const uint32_t> torn, SurfaceChange& change);

} // namespace anvil
