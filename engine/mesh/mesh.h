// The mesh as the file has it: polygons and attributes in file order, triangles beside them.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <string>
#include <vector>

namespace anvil {

/// Number type of a file's column, so that a writer gives back what was read.
enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// One named number per vertex or per polygon (PLY properties, colours, ...). Values are exact in double.
struct Column {
    std::string name;
    ScalarType type = ScalarType::float32;
    std::vector<double> values;
};

/// Data at polygon corners, indexed as OBJ does it: `index` has one entry per corner of Mesh::corners
/// (no_index: this corner has none) into a pool of `values` with `components` numbers each.
struct CornerLayer {
    int components = 0;
    std::vector<double> values;
    std::vector<uint32_t> index;

    bool empty() const { return index.empty(); }
};

/// A statement of an OBJ file that holds for the polygons from `first_polygon` on:
/// "g", "o", "s", "usemtl"; `text` is the rest of its line.
struct GroupMark {
    uint32_t first_polygon = 0;
    std::string keyword;
    std::string text;
};

/// Polygon mesh with its triangulation. Indices are those of the file, isolated vertices included.
/// Polygon f has corners [polygon_begin[f], polygon_begin[f + 1]), at least 3, and the triangles
/// [first_triangle(f), first_triangle(f + 1)), always (corners - 2) of them, fixed at load; a triangle may
/// be degenerate. Any number of faces may share an edge.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<uint32_t> polygon_begin{0}; ///< polygon_count() + 1 entries
    std::vector<uint32_t> corners;          ///< vertex of each polygon corner
    std::vector<Triangle> triangles;

    bool double_precision =
        false; ///< the file's positions need double (double columns, or decimals beyond float)

    std::vector<Column> vertex_columns; ///< positions excluded; normals are "nx","ny","nz"; colours "red",...
    std::vector<Column> polygon_columns; ///< e.g. PLY face properties, STL attribute words
    CornerLayer texture_coordinates;     ///< 2 or 3 components
    CornerLayer corner_normals;          ///< 3 components
    std::vector<GroupMark> groups;       ///< sorted by first_polygon
    std::vector<std::string> comments; ///< PLY comments and obj_info, OBJ "mtllib ..." lines, STL solid name

    size_t vertex_count() const { return positions.size(); }
    size_t polygon_count() const { return polygon_begin.size() - 1; }
    std::span<const uint32_t> polygon(size_t f) const {
        return {corners.data() + polygon_begin[f], corners.data() + polygon_begin[f + 1]};
    }
    size_t first_triangle(size_t f) const { return polygon_begin[f] - 2 * f; }

    /// Appends a polygon's corners; triangulate() afterwards.
    void add_polygon(std::span<const uint32_t> vertices) {
        corners.insert(corners.end(), vertices.begin(), vertices.end());
        polygon_begin.push_back(static_cast<uint32_t>(corners.size()));
    }
};

/// Fills `triangles` from the polygons. Strictly convex polygons become fans; a quad is split so that the two
/// triangles fold least (the shorter diagonal on ties); other polygons are ear-clipped in their mean plane.
void triangulate(Mesh& mesh);

/// Box of all positions.
Box bounds(const Mesh& mesh);

/// Area-weighted vertex normals (unit; zero where no triangle has area), n entries.
std::vector<Vec3> vertex_normals(const Mesh& mesh, std::span<const Vec3> positions);

} // namespace anvil
