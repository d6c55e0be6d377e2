#include "engine/refine/refined_mesh.h"

#include "engine/mesh/mesh_output.h"

#include <numeric>
#include <optional>
#include <unordered_map>

namespace anvil {

namespace {

/// Faces by the triangle that they are part of.
struct FacesOfRoots {
    std::vector<uint32_t> begin;
    std::vector<uint32_t> faces;

    std::span<const uint32_t> of(size_t root) const {
        return {faces.data() + begin[root], faces.data() + begin[root + 1]};
    }
    bool is_divided(size_t root) const { return begin[root + 1] - begin[root] > 1; }
};

FacesOfRoots group_by_root(std::span<const EdgeMesh::Face> faces, size_t triangle_count) {
    FacesOfRoots groups;
    groups.begin.assign(triangle_count + 1, 0);
    for (const EdgeMesh::Face& face : faces) {
        ++groups.begin[face.root + 1];
    }
    std::partial_sum(groups.begin.begin(), groups.begin.end(), groups.begin.begin());
    std::vector<uint32_t> cursor(groups.begin.begin(), groups.begin.end() - 1);
    groups.faces.resize(faces.size());
    for (uint32_t f = 0; f < faces.size(); ++f) {
        groups.faces[cursor[faces[f].root]++] = f;
    }
    return groups;
}

/// Values at the corners of a divided triangle: new ones between those of the parents on the same side of a
/// seam, one for all corners that have the same.
class CornerInterpolation {
  public:
    CornerInterpolation(CornerLayer& layer, size_t old_vertices, std::span<const VertexParents> parents,
                        bool unit)
        : layer_(layer), old_vertices_(old_vertices), parents_(parents), unit_(unit) {}

    /// Begins a triangle whose corners have these entries.
    void begin(const Triangle& corners, const Triangle& entries) {
        known_.clear();
        for (int i = 0; i < 3; ++i) {
            known_.emplace(corners[i], entries[i]);
        }
    }

    uint32_t entry(uint32_t vertex) {
        const auto found = known_.find(vertex);
        if (found != known_.end()) {
            return found->second;
        }
        const VertexParents& p = parents_[vertex - old_vertices_];
        const uint32_t made = entry_between(vertex, entry(p.a), entry(p.b), p.place);
        known_.emplace(vertex, made);
        return made;
    }

  private:
    struct Made {
        uint32_t a, b, entry;
    };

    uint32_t entry_between(uint32_t vertex, uint32_t a, uint32_t b, double place) {
        if (a == no_index || b == no_index) {
            return no_index;
        }
        std::vector<Made>& made = made_[vertex];
        for (const Made& m : made) {
            if (m.a == a && m.b == b) {
                return m.entry;
            }
        }
        made.push_back({a, b, append(a, b, place)});
        return made.back().entry;
    }

    uint32_t append(uint32_t a, uint32_t b, double place) {
        const auto n = static_cast<size_t>(layer_.components);
        const size_t first = layer_.values.size();
        double square = 0;
        for (size_t i = 0; i < n; ++i) {
            const double value = between(layer_.values[a * n + i], layer_.values[b * n + i], place);
            layer_.values.push_back(value);
            square += value * value;
        }
        if (unit_ && square > 0) {
            for (size_t i = first; i < first + n; ++i) {
                layer_.values[i] /= std::sqrt(square);
            }
        }
        return static_cast<uint32_t>(first / n);
    }

    CornerLayer& layer_;
    size_t old_vertices_;
    std::span<const VertexParents> parents_;
    bool unit_;
    std::unordered_map<uint32_t, uint32_t> known_;
    std::unordered_map<uint32_t, std::vector<Made>> made_;
};

void extend_column(Column& column, std::span<const VertexParents> parents) {
    column.values.reserve(column.values.size() + parents.size());
    for (const VertexParents& p : parents) {
        const double value = between(column.values[p.a], column.values[p.b], p.place);
        column.values.push_back(is_integer(column.type) ? std::round(value) : value);
    }
}

/// Interpolated normals are short.
void stretch_normals(Mesh& mesh, size_t first) {
    std::array<Column*, 3> columns{};
    for (Column& column : mesh.vertex_columns) {
        for (size_t i = 0; i < 3; ++i) {
            if (column.name == normal_names[i]) {
                columns[i] = &column;
            }
        }
    }
    if (columns[0] == nullptr || columns[1] == nullptr || columns[2] == nullptr) {
        return;
    }
    for (size_t v = first; v < mesh.vertex_count(); ++v) {
        const Vec3 normal(columns[0]->values[v], columns[1]->values[v], columns[2]->values[v]);
        const double length = glm::length(normal);
        for (int i = 0; i < 3 && length > 0; ++i) {
            columns[i]->values[v] = normal[i] / length;
        }
    }
}

class MeshDivision {
  public:
    MeshDivision(const Mesh& mesh, std::vector<VertexParents> parents, std::span<const EdgeMesh::Face> faces)
        : mesh_(mesh), faces_(faces), groups_(group_by_root(faces, mesh.triangles.size())) {
        result_.parents = std::move(parents);
    }

    RefinedMesh run() {
        extend_vertices();
        Mesh& out = result_.mesh;
        out.texture_coordinates = {
            mesh_.texture_coordinates.components, mesh_.texture_coordinates.values, {}};
        out.corner_normals = {mesh_.corner_normals.components, mesh_.corner_normals.values, {}};
        texture_.emplace(out.texture_coordinates, mesh_.vertex_count(), result_.parents, false);
        normals_.emplace(out.corner_normals, mesh_.vertex_count(), result_.parents, true);
        out.corners.reserve(mesh_.corners.size() + 3 * faces_.size());
        out.triangles.reserve(mesh_.triangles.size() + faces_.size());
        result_.roots.reserve(mesh_.triangles.size() + faces_.size());
        first_polygon_.reserve(mesh_.polygon_count() + 1);
        for (size_t f = 0; f < mesh_.polygon_count(); ++f) {
            first_polygon_.push_back(static_cast<uint32_t>(out.polygon_count()));
            is_divided(f) ? divide_polygon(f) : keep_polygon(f);
        }
        first_polygon_.push_back(static_cast<uint32_t>(out.polygon_count()));
        carry_polygon_data();
        return std::move(result_);
    }

  private:
    void extend_vertices() {
        Mesh& out = result_.mesh;
        out.double_precision = mesh_.double_precision;
        out.comments = mesh_.comments;
        out.positions.reserve(mesh_.vertex_count() + result_.parents.size());
        out.positions = mesh_.positions;
        for (const VertexParents& p : result_.parents) {
            out.positions.push_back(between(out.positions[p.a], out.positions[p.b], p.place));
        }
        out.vertex_columns = mesh_.vertex_columns;
        for (Column& column : out.vertex_columns) {
            extend_column(column, result_.parents);
        }
        stretch_normals(out, mesh_.vertex_count());
    }

    bool is_divided(size_t polygon) const {
        for (size_t t = mesh_.first_triangle(polygon); t < mesh_.first_triangle(polygon + 1); ++t) {
            if (groups_.is_divided(t)) {
                return true;
            }
        }
        return false;
    }

    void keep_polygon(size_t f) {
        Mesh& out = result_.mesh;
        out.add_polygon(mesh_.polygon(f));
        for (size_t t = mesh_.first_triangle(f); t < mesh_.first_triangle(f + 1); ++t) {
            out.triangles.push_back(mesh_.triangles[t]);
            result_.roots.push_back(static_cast<uint32_t>(t));
        }
        keep_corners(mesh_.texture_coordinates, out.texture_coordinates, f);
        keep_corners(mesh_.corner_normals, out.corner_normals, f);
    }

    void keep_corners(const CornerLayer& from, CornerLayer& to, size_t f) const {
        if (!from.empty()) {
            to.index.insert(to.index.end(), from.index.begin() + mesh_.polygon_begin[f],
                            from.index.begin() + mesh_.polygon_begin[f + 1]);
        }
    }

    void divide_polygon(size_t f) {
        for (size_t t = mesh_.first_triangle(f); t < mesh_.first_triangle(f + 1); ++t) {
            const Triangle places = corner_places(f, mesh_.triangles[t]);
            begin_layer(texture_, mesh_.texture_coordinates, mesh_.triangles[t], places);
            begin_layer(normals_, mesh_.corner_normals, mesh_.triangles[t], places);
            if (groups_.of(t).empty()) {
                add_triangle(mesh_.triangles[t], t);
            }
            for (const uint32_t face : groups_.of(t)) {
                add_triangle(faces_[face].corners, t);
            }
        }
    }

    /// The polygon's corners (as numbered in Mesh::corners) that a triangle of it has.
    Triangle corner_places(size_t f, const Triangle& triangle) const {
        Triangle places{};
        for (int i = 0; i < 3; ++i) {
            uint32_t c = mesh_.polygon_begin[f];
            // A polygon may pass a vertex twice; its triangle then means the corner that is not yet taken.
            while (mesh_.corners[c] != triangle[i] || (i > 0 && c == places[0]) ||
                   (i > 1 && c == places[1])) {
                ++c;
            }
            places[i] = c;
        }
        return places;
    }

    static void begin_layer(std::optional<CornerInterpolation>& layer, const CornerLayer& from,
                            const Triangle& corners, const Triangle& places) {
        if (!from.empty()) {
            layer->begin(corners, {from.index[places[0]], from.index[places[1]], from.index[places[2]]});
        }
    }

    void add_triangle(const Triangle& corners, size_t root) {
        Mesh& out = result_.mesh;
        out.add_polygon(corners);
        out.triangles.push_back(corners);
        result_.roots.push_back(static_cast<uint32_t>(root));
        for (const uint32_t v : corners) {
            if (!mesh_.texture_coordinates.empty()) {
                out.texture_coordinates.index.push_back(texture_->entry(v));
            }
            if (!mesh_.corner_normals.empty()) {
                out.corner_normals.index.push_back(normals_->entry(v));
            }
        }
    }

    void carry_polygon_data() {
        Mesh& out = result_.mesh;
        for (const Column& column : mesh_.polygon_columns) {
            out.polygon_columns.push_back({column.name, column.type, {}});
            std::vector<double>& values = out.polygon_columns.back().values;
            for (size_t f = 0; f < mesh_.polygon_count(); ++f) {
                values.insert(values.end(), first_polygon_[f + 1] - first_polygon_[f], column.values[f]);
            }
        }
        out.groups = mesh_.groups;
        for (GroupMark& mark : out.groups) {
            mark.first_polygon = first_polygon_[mark.first_polygon];
        }
    }

    const Mesh& mesh_;
    std::span<const EdgeMesh::Face> faces_;
    FacesOfRoots groups_;
    RefinedMesh result_;
    std::optional<CornerInterpolation> texture_, normals_; ///< made once the parents have their place
    std::vector<uint32_t> first_polygon_;                  ///< per polygon before: the first polygon after
};

} // namespace

RefinedMesh divided(const Mesh& mesh, std::vector<VertexParents> parents,
                    std::span<const EdgeMesh::Face> faces) {
    return MeshDivision(mesh, std::move(parents), faces).run();
}

} // namespace anvil
