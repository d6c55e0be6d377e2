#include "engine/mesh/mesh.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

Mesh polygon_mesh(std::vector<Vec3> points) {
    Mesh mesh;
    mesh.positions = std::move(points);
    std::vector<uint32_t> corners;
    for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
        corners.push_back(i);
    }
    mesh.add_polygon(corners);
    triangulate(mesh);
    return mesh;
}

double signed_area_z(const Mesh& mesh, const Triangle& t) {
    return 0.5 * glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                            mesh.positions[t[2]] - mesh.positions[t[0]])
                     .z;
}

/// Sum of the triangles' areas, each of which must be counterclockwise.
double covered_area(const Mesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        CHECK(signed_area_z(mesh, t) > 0);
        sum += signed_area_z(mesh, t);
    }
    return sum;
}

} // namespace

TEST_CASE("A polygon of n corners has n - 2 triangles that cover exactly its area", "[mesh]") {
    const std::vector<std::pair<std::vector<Vec3>, double>> shapes = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1},
        {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}, 4},             // dart
        {{{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}, 4},             // dart, turned by two corners
        {{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}}, 7}, // convex pentagon
        {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4},  // a corner on a side
        {{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {0, 1, 0}}, 5},                       // L
        {{{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 9}, // U
    };
    for (const auto& [points, area] : shapes) {
        const Mesh mesh = polygon_mesh(points);
        REQUIRE(mesh.triangles.size() == points.size() - 2);
        CHECK(covered_area(mesh) == Approx(area).epsilon(1e-14));
        for (const double scale : {0x1p-100, 0x1p100}) {
            std::vector<Vec3> scaled = points;
            for (Vec3& p : scaled) {
                p *= scale;
            }
            CHECK(polygon_mesh(scaled).triangles == mesh.triangles);
        }
    }
}

TEST_CASE("A quad is split where it folds least, and a flat one along its shorter diagonal", "[mesh]") {
    // Cosine of the fold: 2/3 across the diagonal of (0,0,0), 2/sqrt(10) across the other one.
    const Mesh lifted = polygon_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 1}});
    CHECK(lifted.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    const Mesh turned = polygon_mesh({{2, 0, 0}, {2, 1, 0}, {0, 1, 1}, {0, 0, 0}});
    CHECK(turned.triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
    const Mesh flat = polygon_mesh({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}});
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("Polygons without a plane still have n - 2 triangles", "[mesh]") {
    CHECK(polygon_mesh({6, Vec3{1, 2, 3}}).triangles.size() == 4);
    CHECK(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).triangles.size() == 3);
    // a pentagram crosses itself
    CHECK(polygon_mesh({{0, 1, 0}, {-.6, -.8, 0}, {.95, .3, 0}, {-.95, .3, 0}, {.6, -.8, 0}})
              .triangles.size() == 3);
}

TEST_CASE("Vertex normals are unit, outward, independent of scale, and zero for isolated vertices",
          "[mesh]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.add_polygon(std::vector<uint32_t>{0, 1, 2, 3});
    triangulate(mesh);
    for (const double scale : {1e-30, 1.0, 1e30, 1e200}) {
        for (Vec3& p : mesh.positions) {
            p *= scale;
        }
        const std::vector<Vec3> normals = vertex_normals(mesh, mesh.positions);
        for (size_t v = 0; v < 4; ++v) {
            CHECK(normals[v] == Vec3(0, 0, 1));
        }
        CHECK(normals[4] == Vec3(0));
        for (Vec3& p : mesh.positions) {
            p /= scale;
        }
    }
}

TEST_CASE("The bounds hold every vertex, isolated ones included", "[mesh]") {
    Mesh mesh;
    CHECK(bounds(mesh).empty());
    mesh.positions = {{0, 0, 0}, {-1, 2, 5}};
    CHECK(bounds(mesh).low == Vec3(-1, 0, 0));
    CHECK(bounds(mesh).high == Vec3(0, 2, 5));
}
