// What a mesh is like and what is wrong with it, for `anvil info` and for warnings after loading.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh.h"

#include <optional>

namespace anvil {

/// How many of a kind, and the (0-based) index of the first one.
struct Finding {
    size_t count = 0;
    size_t first = 0; ///< meaningless while count is 0

    void add(size_t index) {
        if (count++ == 0) {
            first = index;
        }
    }
};

/// Edges are those of the polygons, not the diagonals of their triangulation. Angles in degrees, lengths in
/// the file's unit. A mesh is closed if every edge is run through as often in one direction as in the other.
struct MeshHealth {
    size_t vertices = 0;
    size_t polygons = 0;
    size_t triangles = 0;
    size_t edges = 0;
    size_t components =
        0; ///< polygons are connected where they share a vertex; isolated vertices not counted
    size_t boundary_edges = 0;    ///< used by one polygon
    size_t boundary_loops = 0;    ///< holes that touch in a vertex count as one
    Finding non_manifold_edges;   ///< used by three polygons or more; first: the edge's lower vertex
    Finding bowtie_vertices;      ///< vertices whose polygons form several fans joined only there
    Finding inconsistent_edges;   ///< run through by two polygons in one direction; first: the lower vertex
    Finding isolated_vertices;    ///< used by no polygon
    Finding degenerate_triangles; ///< height on the longest edge at most 1e-10 of that edge
    Finding duplicate_positions;  ///< vertices at exactly the position of an earlier vertex
    Finding nonplanar_polygons;   ///< some corner farther than 1e-3 of the polygon's size from its mean plane
    Finding folded_polygons;      ///< the same with 0.1: their triangulation matters for the shape
    double min_angle = 0;         ///< of the triangles that are not degenerate
    size_t needles = 0;           ///< triangles, not degenerate, with an angle below 5 degrees
    long long euler_number = 0;   ///< used vertices - edges + polygons
    bool closed = false;
    Box box; ///< of all vertices, isolated ones included
    double diagonal = 0;
    double area = 0;
    std::optional<double> volume; ///< of closed meshes; negative if the polygons face inwards
};

/// Linear time but for sorting. Any mesh with valid indices and finite positions.
MeshHealth examine(const Mesh& mesh);

/// Adds a warning for each kind of finding that can spoil an edit, and for coordinates beyond what
/// single precision copes with (far_from_origin(), 1e12 units and more, diagonals below 1e-12).
void warn_about(const MeshHealth& health, Log& log);

/// Whether rounding the coordinates to float would move vertices by more than 1e-4 of the diagonal.
bool far_from_origin(const Box& box);

} // namespace anvil
