#include "app/cli/mesh_summary.h"

#include "engine/core/number_text.h"

#include <iterator>
#include <nlohmann/json.hpp>

namespace anvil {

namespace {

struct NamedFinding {
    const char* key;
    const char* title;
    const char* place;
    const Finding& finding;
};

std::vector<NamedFinding> findings(const MeshHealth& health) {
    return {{"non_manifold_edges", "non-manifold edges", "vertex", health.non_manifold_edges},
            {"bowtie_vertices", "bow-tie vertices", "vertex", health.bowtie_vertices},
            {"inconsistent_edges", "edges with flipped faces", "vertex", health.inconsistent_edges},
            {"isolated_vertices", "isolated vertices", "vertex", health.isolated_vertices},
            {"duplicate_positions", "repeated positions", "vertex", health.duplicate_positions},
            {"degenerate_triangles", "triangles without area", "triangle", health.degenerate_triangles},
            {"nonplanar_faces", "faces that are not flat", "face", health.nonplanar_polygons},
            {"folded_faces", "faces far from flat", "face", health.folded_polygons}};
}

std::string point_text(const Vec3& p) {
    return "(" + rounded_text(p.x) + ", " + rounded_text(p.y) + ", " + rounded_text(p.z) + ")";
}

std::vector<std::string> names_of(const std::vector<Column>& columns) {
    std::vector<std::string> names;
    names.reserve(columns.size());
    for (const Column& column : columns) {
        names.push_back(column.name);
    }
    return names;
}

std::vector<std::string> corner_attributes(const Mesh& mesh) {
    std::vector<std::string> names;
    if (!mesh.texture_coordinates.empty()) {
        names.emplace_back("texture_coordinates");
    }
    if (!mesh.corner_normals.empty()) {
        names.emplace_back("normals");
    }
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text.empty() ? "none" : text;
}

/// "key:  value" lines whose values stand below each other.
class Table {
  public:
    void row(const std::string& title, const std::string& value) {
        constexpr size_t column = 27;
        const std::string gap(title.size() + 1 < column ? column - title.size() - 1 : 1, ' ');
        text_ += title + ":" + gap + value + "\n";
    }
    void row(const std::string& title, size_t count) { row(title, std::to_string(count)); }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

nlohmann::ordered_json finding_json(const Finding& finding) {
    nlohmann::ordered_json value{{"count", finding.count}, {"first", nullptr}};
    if (finding.count > 0) {
        value["first"] = finding.first;
    }
    return value;
}

} // namespace

std::string summary_table(const std::string& file, const Mesh& mesh, const MeshHealth& health) {
    Table table;
    table.row("file", file);
    table.row("vertices", health.vertices);
    table.row("faces", health.polygons);
    table.row("triangles", health.triangles);
    table.row("edges", health.edges);
    table.row("components", health.components);
    table.row("closed", health.closed ? "yes" : "no");
    table.row("boundary", std::to_string(health.boundary_edges) + " edges in " +
                              std::to_string(health.boundary_loops) + " loops");
    table.row("Euler number", std::to_string(health.euler_number));
    table.row("extent", health.box.empty()
                            ? "none"
                            : point_text(health.box.low) + " to " + point_text(health.box.high));
    table.row("diagonal", rounded_text(health.diagonal));
    table.row("area", rounded_text(health.area));
    table.row("volume", health.volume ? rounded_text(*health.volume) : "none: the mesh is open");
    table.row("smallest angle", rounded_text(health.min_angle) + " degrees");
    table.row("triangles below 5 degrees", health.needles);
    for (const NamedFinding& named : findings(health)) {
        const Finding& found = named.finding;
        table.row(named.title, std::to_string(found.count) +
                                   (found.count == 0 ? std::string()
                                                     : std::string(" (first at ") + named.place + " " +
                                                           std::to_string(found.first) + ")"));
    }
    table.row("coordinates", mesh.double_precision ? "double precision" : "single precision");
    table.row("vertex attributes", joined(names_of(mesh.vertex_columns)));
    table.row("face attributes", joined(names_of(mesh.polygon_columns)));
    table.row("corner attributes", joined(corner_attributes(mesh)));
    table.row("group statements", mesh.groups.size());
    return table.text();
}

std::string summary_json(const std::string& file, const Mesh& mesh, const MeshHealth& health,
                         const Log& log) {
    nlohmann::ordered_json out{{"file", file},
                               {"vertices", health.vertices},
                               {"faces", health.polygons},
                               {"triangles", health.triangles},
                               {"edges", health.edges},
                               {"components", health.components},
                               {"closed", health.closed},
                               {"boundary_edges", health.boundary_edges},
                               {"boundary_loops", health.boundary_loops},
                               {"euler_number", health.euler_number},
                               {"low", nullptr},
                               {"high", nullptr},
                               {"diagonal", health.diagonal},
                               {"area", health.area},
                               {"volume", nullptr},
                               {"min_angle", health.min_angle},
                               {"needles", health.needles}};
    if (!health.box.empty()) {
        out["low"] = {health.box.low.x, health.box.low.y, health.box.low.z};
        out["high"] = {health.box.high.x, health.box.high.y, health.box.high.z};
    }
    if (health.volume) {
        out["volume"] = *health.volume;
    }
    for (const NamedFinding& named : findings(health)) {
        out[named.key] = finding_json(named.finding);
    }
    out["double_precision"] = mesh.double_precision;
    out["vertex_attributes"] = names_of(mesh.vertex_columns);
    out["face_attributes"] = names_of(mesh.polygon_columns);
    out["corner_attributes"] = corner_attributes(mesh);
    out["groups"] = mesh.groups.size();
    out["warnings"] = log.warnings;
    // A file name or attribute that is not UTF-8 is shown with replacement characters.
    return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace anvil
