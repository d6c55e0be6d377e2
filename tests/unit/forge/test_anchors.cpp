#include "engine/core/error.h"
#include "engine/forge/edit_region.h"
#include "tests/support/forging.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// The square [-0.5, 0.5]^2 of n x n quads with random inner vertices: flat, so that distances are straight.
Mesh quad_square(int n) {
    const Mesh split = surfaces::plane(n, n, 1, 1, 0.2);
    Mesh mesh;
    mesh.positions = split.positions;
    for (Vec3& p : mesh.positions) {
        p -= Vec3(0.5, 0.5, 0);
    }
    for (uint32_t j = 0; j < static_cast<uint32_t>(n); ++j) {
        for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i) {
            const uint32_t a = j * (n + 1) + i, d = a + n + 1;
            mesh.add_polygon(std::array<uint32_t, 4>{a, a + 1, d + 1, d});
        }
    }
    triangulate(mesh);
    return mesh;
}

/// gamma of the only handle at each vertex, infinite beyond the radius of 10 or out of reach.
std::vector<double> gamma(const Mesh& mesh, const std::string& anchors, const std::string& extra = "") {
    const Recipe recipe = edit_recipe("{ 'kind': 'translate', 'radius': 10, 'method': 'exact', " + extra +
                                      "'anchors': [ {'at': [" + anchors +
                                      "]} ], 'handles': [ {'at': {'vertex': 0}, 'by': [0,0,1]} ] }");
    const RefinementHistory unrefined(mesh);
    KeptSolvers solvers;
    SurfaceState surface(mesh, mesh.positions, unrefined, solvers);
    const EditRegion region = find_region(recipe.edits[0], "edits[0]", surface);
    std::vector<double> result(mesh.vertex_count(), infinity);
    for (size_t i = 0; i < region.vertices.size(); ++i) {
        result[region.vertices[i]] = 10 * region.fields[i];
    }
    return result;
}

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a));
}

std::string complaint(const Mesh& mesh, const std::string& anchors) {
    try {
        gamma(mesh, anchors);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("a polyline anchor between far points is the straight line on a flat mesh, in both metrics") {
    const Mesh mesh = quad_square(30);
    const std::vector<Vec3> corners = {{-0.31, -0.22, 0}, {0.33, 0.04, 0}, {-0.1, 0.37, 0}};
    std::string points;
    for (const Vec3& p : corners) {
        points += (points.empty() ? "{'nearest': " : ", {'nearest': ") + text(p) + "}";
    }
    for (const char* metric : {"'metric': 'geodesic', ", "'metric': 'euclidean', "}) {
        const std::vector<double> found = gamma(mesh, "{'polyline': [" + points + "]}", metric);
        double worst = 0;
        for (size_t v = 0; v < found.size(); ++v) {
            const Vec3& p = mesh.positions[v];
            const double expected =
                std::min(to_segment(p, corners[0], corners[1]), to_segment(p, corners[1], corners[2]));
            worst = std::max(worst, std::abs(found[v] - expected));
        }
        // Rays of a line come from 1e7 lengths away (geodesic metric).
        CHECK(worst < 3e-9);
    }
}

TEST_CASE("a whole face is the file's polygon with all its triangles") {
    const Mesh mesh = quad_square(12);
    const uint32_t face = 65;
    const std::span<const uint32_t> polygon = mesh.polygon(face);
    for (const char* metric : {"'metric': 'geodesic', ", "'metric': 'euclidean', "}) {
        const std::vector<double> found = gamma(mesh, "{'face': 65}", metric);
        for (size_t v = 0; v < found.size(); ++v) {
            double expected = infinity;
            for (size_t k = 0; k < 4; ++k) {
                expected = std::min(expected, to_segment(mesh.positions[v], mesh.positions[polygon[k]],
                                                         mesh.positions[polygon[(k + 1) % 4]]));
            }
            CHECK(found[v] == Approx(expected).margin(3e-9));
        }
    }
}

TEST_CASE("a smooth blend of anchors lies between zero and the nearest one, and ends as that") {
    const Mesh mesh = quad_square(40);
    const std::string anchors = "{'nearest': [-0.2,-0.1,0]}, {'polyline': [{'nearest': [0.2,-0.3,0]}, "
                                "{'nearest': [0.25,0.3,0]}]}, {'face': 1300}";
    const auto blended = [&](double width) {
        const Recipe recipe = edit_recipe("{ 'kind': 'translate', 'radius': 10, 'anchors': [ {'at': [" +
                                          anchors + "], 'blend': {'smooth': " + text(width) +
                                          "}} ], 'handles': [ {'at': {'vertex': 0}, 'by': [0,0,1]} ] }");
        const RefinementHistory unrefined(mesh);
        KeptSolvers solvers;
        SurfaceState surface(mesh, mesh.positions, unrefined, solvers);
        return find_region(recipe.edits[0], "edits[0]", surface);
    };
    const std::vector<double> nearest = gamma(mesh, anchors);
    const EditRegion wide = blended(0.05), narrow = blended(1e-7);
    REQUIRE(wide.vertices.size() == mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const double found = 10 * wide.fields[wide.index_of(v)];
        CHECK(found >= 0);
        CHECK(found <= nearest[v] + 1e-12);
        CHECK(found >= nearest[v] - 0.05 * std::log(3.0) - 1e-12);
        CHECK(10 * narrow.fields[narrow.index_of(v)] == Approx(nearest[v]).margin(2e-7));
        CHECK((nearest[v] > 1e-9 || found <= 1e-9));
    }
}

TEST_CASE("an anchor that is given twice in other words counts once") {
    const Mesh mesh = quad_square(12);
    // Vertex 30 is a corner of face 27; an edge point and a line have several names too.
    const auto blend = [&](const std::string& anchors) {
        const Recipe recipe = edit_recipe(
            "{ 'kind': 'translate', 'radius': 10, 'anchors': [ {'at': [" + anchors +
            "], 'blend': {'smooth': 0.1}} ], 'handles': [ {'at': {'vertex': 0}, 'by': [0,0,1]} ] }");
        const RefinementHistory unrefined(mesh);
        KeptSolvers solvers;
        SurfaceState surface(mesh, mesh.positions, unrefined, solvers);
        return find_region(recipe.edits[0], "edits[0]", surface).fields;
    };
    const size_t first = mesh.first_triangle(27);
    std::string corner;
    for (int k = 0; k < 3; ++k) {
        const uint32_t v = mesh.triangles[first][k];
        if (v == mesh.polygon(27)[0]) {
            corner = k == 0 ? "[1,0,0]" : k == 1 ? "[0,1,0]" : "[0,0,1]";
        }
    }
    const std::string vertex = "{'vertex': " + std::to_string(mesh.polygon(27)[0]) + "}";
    const std::string same = "{'face': 27, 'triangle': 0, 'barycentric': " + corner + "}";
    const std::string line = "{'polyline': [{'vertex': 100}, {'vertex': 150}]}",
                      back = "{'polyline': [{'vertex': 150}, {'vertex': 100}]}";
    const auto once = blend(vertex + "," + line + ", {'face': 3}");
    CHECK(blend(vertex + "," + same + "," + line + ", {'face': 3}") == once);
    CHECK(blend(vertex + "," + line + "," + back + ", {'face': 3}, {'face': 3}") == once);
    const auto turned = blend("{'face': 3}, " + line + "," + vertex);
    for (size_t i = 0; i < once.size(); ++i) {
        CHECK(turned[i] == Approx(once[i]).margin(1e-12));
    }
}

TEST_CASE("anchors that cannot be are refused with their place and what would mend it") {
    Mesh mesh = quad_square(6);
    const auto count = static_cast<uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
    mesh.add_polygon(std::array<uint32_t, 3>{count, count + 1, count + 2});
    triangulate(mesh);
    const auto check = [&](const std::string& anchors, const std::vector<std::string>& words) {
        const std::string message = complaint(mesh, anchors);
        INFO(message);
        for (const std::string& word : words) {
            CHECK(message.find(word) != std::string::npos);
        }
    };
    check("{'face': 37}", {"edits[0].anchors[0].at[0]", "face 37", "37 faces"});
    check("{'vertex': 1}, {'polyline': [{'vertex': 1}, {'vertex': 99}]}",
          {"edits[0].anchors[0].at[1].polyline[1]", "vertex 99"});
    check("{'polyline': [{'vertex': 1}, {'vertex': 2}, {'vertex': 50}]}",
          {"anchors[0].at[0].polyline", "from point 1 to point 2", "different components"});
}

TEST_CASE("anchors move with their surface: a later edit finds them by their address") {
    const Mesh mesh = quad_square(16);
    const std::string line = "'anchors': [ {'at': [ {'polyline': [{'vertex': 139}, {'vertex': 147}]} ]} ], ";
    const std::string edit = "{ 'kind': 'translate', 'radius': 0.3, " + line +
                             "'handles': [ {'at': {'vertex': 143}, 'by': [0,0,0.2]} ] }";
    const ForgeResult once = forged_on_cpu(mesh, edit_recipe(edit));
    const ForgeResult twice = forged_on_cpu(mesh, edit_recipe(edit + ", " + edit));
    CHECK(once.positions[143].z == Approx(0.2).epsilon(1e-12));
    CHECK(twice.positions[143].z == Approx(0.4).epsilon(1e-12));
    // The line's ends are on it in both edits, wherever the first has moved them; the handle stands a part of
    // a cell (of 0.0625) beside it.
    for (const uint32_t end : {139U, 147U}) {
        CHECK(once.positions[end].z >= 0.2 - 1e-12);
        CHECK(once.positions[end].z < 0.22);
        CHECK(twice.positions[end].z >= 0.2 + once.positions[end].z - 1e-12);
        CHECK(twice.positions[end].z < 0.22 + once.positions[end].z);
    }
}

TEST_CASE("distances on a smoothed copy make a pushed dome round beside a spike") {
    Mesh mesh = quad_square(60);
    const uint32_t spike = 30 * 61 + 38;
    mesh.positions[spike].z = 0.15;
    triangulate(mesh);
    // 0.05 of the square is 3 cells; the spike stands at 8 cells from the handle.
    const auto spread = [&](const std::string& extra) {
        const std::vector<double> found = gamma(mesh, "{'vertex': 1860}", extra);
        double worst = 0;
        for (size_t v = 0; v < found.size(); ++v) {
            const Vec3 d = mesh.positions[v] - mesh.positions[1860];
            const double flat = std::hypot(d.x, d.y);
            worst = flat > 0.05 && flat < 0.3 ? std::max(worst, std::abs(found[v] / flat - 1)) : worst;
        }
        return worst;
    };
    CHECK(spread("") > 0.3);
    CHECK(spread("'smooth_surface': 20, ") < 0.05);
}

TEST_CASE("the report names each handle's method, exact where faces share an edge by threes") {
    const auto methods = [](const Mesh& mesh, const std::string& extra) {
        const ForgeResult result = forged_on_cpu(
            mesh,
            edit_recipe("{ 'kind': 'translate', " + extra +
                        "'handles': [ {'at': {'vertex': 40}, 'by': [0,0,0.1]}, "
                        "{'at': {'vertex': 3}, 'by': [0,0,0.1], 'metric': 'euclidean', 'radius': 0.2} ] }"));
        const auto handles = nlohmann::json::parse(report_json(result.report))["edits"][0]["handles"];
        return std::pair<std::string, std::string>(handles[0]["method"], handles[1]["method"]);
    };
    const Mesh small = quad_square(20), large = quad_square(90);
    CHECK(methods(small, "'radius': 2, ") == std::pair<std::string, std::string>("exact", "euclidean"));
    CHECK(methods(large, "'radius': 2, ").first == "approximate");
    CHECK(methods(large, "'radius': 0.2, ").first == "exact");
    CHECK(methods(small, "'radius': 2, 'method': 'approximate', ").first == "approximate");
    // Three sheets on one edge, more vertices than are measured exactly without a reason.
    const surfaces::Sheets sheets = surfaces::three_sheets(45);
    REQUIRE(sheets.mesh.vertex_count() > 6000);
    CHECK(methods(sheets.mesh, "'radius': 200, ").first == "exact");
}

TEST_CASE("refinement keeps the crease along a line and around a face, and addresses find them again") {
    const Mesh mesh = quad_square(10);
    const Vec3 a = mesh.positions[46], b = mesh.positions[74];
    const std::string line = "{'polyline': [{'vertex': 46}, {'vertex': 74}]}";
    const std::string edit = "{ 'kind': 'translate', 'radius': 0.15, 'shape': 'linear', 'method': 'exact', "
                             "'refine': {'tolerance': 0.02}, 'anchors': [ {'at': [" +
                             line +
                             ", {'face': 88}]} ], 'handles': [ {'at': {'vertex': 46}, 'by': [0,0,0.1]} ] }";
    const ForgeResult result = forged_on_cpu(mesh, edit_recipe(edit));
    REQUIRE(result.refined);
    const std::span<const uint32_t> face = mesh.polygon(88);
    double worst = 0;
    size_t on_line = 0;
    for (size_t v = 0; v < result.positions.size(); ++v) {
        const Vec3 p(result.positions[v].x, result.positions[v].y, 0);
        double d = to_segment(p, a, b);
        on_line += d < 1e-9 ? 1 : 0;
        for (size_t k = 0; k < 4; ++k) {
            d = std::min(d, to_segment(p, mesh.positions[face[k]], mesh.positions[face[(k + 1) % 4]]));
        }
        worst = std::max(worst, std::abs(result.positions[v].z - 0.1 * std::max(0.0, 1 - d / 0.15)));
    }
    // The line crosses some five columns and two rows of cells with their diagonals.
    CHECK(on_line >= 10);
    // A new vertex gets what is linear between the ends of its edge; where fronts are round, past the ends of
    // the line, that is off by h^2 / 8 d: cells of h = 0.1 at d = 0.1 give 0.0125 of the radius of 0.15.
    CHECK(worst < 0.1 * 0.0125 / 0.15);
    // The same once more, on the refined mesh: the face is all its parts.
    const ForgeResult twice = forged_on_cpu(mesh, edit_recipe(edit + ", " + edit));
    double highest = 0;
    for (const uint32_t corner : face) {
        highest = std::max(highest, std::abs(twice.positions[corner].z - 0.2));
    }
    CHECK(highest < 1e-9);
}
