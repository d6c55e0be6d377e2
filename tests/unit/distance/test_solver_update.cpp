#include "engine/distance/surface_tables.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/refine/point_vertices.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

struct Shape {
    std::string name;
    Mesh mesh;
};

Mesh stretched(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) {
        p *= by;
    }
    return mesh;
}

/// Of all kinds; none has four corners of neighbouring triangles on one circle, where two ways to cut are
/// equally good.
std::vector<Shape> shapes() {
    Mesh open_sphere = sphere(4);
    for (size_t i = 0; i < open_sphere.positions.size(); ++i) {
        open_sphere.positions[i] *= 1 + 0.02 * std::sin(static_cast<double>(7 * i));
    }
    Mesh sheets = three_sheets(16).mesh;
    for (size_t i = 0; i < sheets.positions.size(); ++i) {
        sheets.positions[i].y += 0.1 * std::sin(static_cast<double>(5 * i));
    }
    return {{"plane", plane(40, 30, 4, 3, 0.3)},
            {"bumps", bumps(45, 0.1)},
            {"needles", stretched(bumps(45, 0.1), {1, 5, 1})},
            {"dented sphere", std::move(open_sphere)},
            {"hand", make_sample("hand", 3000)},
            {"three sheets", std::move(sheets)}};
}

struct Random {
    std::mt19937 engine;
    double operator()() { return engine() / 4294967296.0; }
    size_t below(size_t count) { return engine() % count; }
};

/// Points of all kinds on `count` triangles near a random place.
RefinedMesh refined_somewhere(const Mesh& mesh, size_t count, Random& random) {
    const Triangle& chosen = mesh.triangles[random.below(mesh.triangles.size())];
    const Vec3 centre = mesh.positions[chosen[0]];
    std::vector<uint32_t> order(mesh.triangles.size());
    for (uint32_t t = 0; t < order.size(); ++t) {
        order[t] = t;
    }
    const auto away = [&](uint32_t t) { return glm::length(mesh.positions[mesh.triangles[t][0]] - centre); };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return away(a) < away(b); });
    std::vector<SurfacePoint> points;
    for (size_t i = 0; i < count; ++i) {
        SurfacePoint point{order[i], Vec3(0.05 + random(), 0.05 + random(), 0.05 + random()), no_index};
        if (random() < 0.4) {
            point.barycentric[static_cast<int>(random.below(3))] = 0;
        }
        point.barycentric /= point.barycentric.x + point.barycentric.y + point.barycentric.z;
        points.push_back(point);
    }
    return make_vertices(mesh, points).refined;
}

void move_somewhere(Mesh& mesh, Random& random) {
    const Vec3 centre = mesh.positions[mesh.triangles[random.below(mesh.triangles.size())][0]];
    Box box;
    for (const Vec3& p : mesh.positions) {
        box.include(p);
    }
    for (Vec3& p : mesh.positions) {
        const double d = glm::length(p - centre) / (0.08 * box.diagonal());
        p += d < 1 ? 0.01 * box.diagonal() * (1 - d * d) * Vec3(0.2, -0.3, 1) : Vec3(0);
    }
}

std::vector<SurfacePoint> some_sources(const Mesh& mesh, Random& random) {
    std::vector<SurfacePoint> sources;
    for (int i = 0; i < 2; ++i) {
        sources.push_back(
            {static_cast<uint32_t>(random.below(mesh.triangles.size())), Vec3(0.5, 0.2, 0.3), no_index});
    }
    return sources;
}

double worst_difference(const GeodesicSolver& a, const GeodesicSolver& b, const Mesh& mesh, Random& random,
                        DistanceMethod method) {
    const std::vector<SurfacePoint> sources = some_sources(mesh, random);
    return worst_relative(a.solve(sources, infinity, method).dense(mesh.vertex_count()),
                          b.solve(sources, infinity, method).dense(mesh.vertex_count()), 1e-3);
}

/// The other end and the length of each intrinsic edge at a vertex of the mesh, in order of these.
std::vector<std::pair<uint32_t, float>> edges_at(const SurfaceTables& tables, uint32_t mesh_vertex) {
    std::vector<std::pair<uint32_t, float>> edges;
    const uint32_t v = tables.graph.numbering.new_vertex[mesh_vertex];
    for (uint32_t i = tables.fans.fans[v].first_spoke; i < tables.fans.fans[v + 1].first_spoke; ++i) {
        const Spoke& spoke = tables.fans.spokes[i];
        edges.emplace_back(tables.graph.numbering.mesh_vertex[spoke.vertex], spoke.length);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// How many vertices have other edges in the one than in the other.
size_t different_vertices(const SurfaceTables& a, const SurfaceTables& b) {
    size_t different = 0;
    for (uint32_t v = 0; v < a.graph.vertex_count(); ++v) {
        const auto one = edges_at(a, v), two = edges_at(b, v);
        different += std::equal(one.begin(), one.end(), two.begin(), two.end(),
                                [](const auto& p, const auto& q) {
                                    return p.first == q.first && std::abs(p.second - q.second) < 1e-6F;
                                })
                         ? 0
                         : 1;
    }
    return different;
}

/// Spokes whose other end has none back in the direction that they say.
size_t spokes_without_return(const FanTable& table) {
    size_t without = 0;
    for (uint32_t v = 0; v + 1 < table.fans.size(); ++v) {
        for (uint32_t i = table.fans[v].first_spoke; i < table.fans[v + 1].first_spoke; ++i) {
            const Spoke& out = table.spokes[i];
            const auto first = table.spokes.begin() + table.fans[out.vertex].first_spoke;
            const auto end = table.spokes.begin() + table.fans[out.vertex + size_t{1}].first_spoke;
            const bool tangled =
                table.fans[out.vertex].total == Fan::tangled || table.fans[v].total == Fan::tangled;
            without += tangled || std::any_of(first, end,
                                              [&](const Spoke& back) {
                                                  return back.vertex == v && back.length == out.length &&
                                                         std::abs(back.direction - out.back) < 1e-5F;
                                              })
                           ? 0
                           : 1;
        }
    }
    return without;
}

} // namespace

TEST_CASE("a solver kept up to date over refinements and moves gives the distances of a new one") {
    Random random{std::mt19937(11)};
    size_t kept_up = 0, all = 0;
    for (Shape& shape : shapes()) {
        Mesh mesh = std::move(shape.mesh);
        GeodesicSolver solver(mesh, mesh.positions);
        solver.solve(some_sources(mesh, random), infinity, DistanceMethod::exact); // its tables exist now
        for (int round = 0; round < 4; ++round) {
            std::vector<uint32_t> roots;
            if (round != 2) {
                RefinedMesh refined = refined_somewhere(mesh, 1 + random.below(25), random);
                mesh = std::move(refined.mesh);
                roots = std::move(refined.roots);
            }
            if (round >= 2) {
                move_somewhere(mesh, random);
            }
            const SolverUpdate update = solver.update(mesh, mesh.positions, roots);
            kept_up += update.whole ? 0 : 1;
            ++all;
            const GeodesicSolver fresh(mesh, mesh.positions);
            INFO(shape.name << " round " << round << " whole " << update.whole);
            CHECK(worst_difference(solver, fresh, mesh, random, DistanceMethod::exact) < 1e-10);
            // Vertices with other numbers arrive in another order. A turned mesh differs by up to 5e-3 for
            // that, and by 2e-2 where the fronts of edges with three triangles meet.
            CHECK(worst_difference(solver, fresh, mesh, random, DistanceMethod::approximate) <
                  (shape.name == "three sheets" ? 1e-2 : 2e-4));
        }
    }
    CHECK(kept_up == all);
}

TEST_CASE("tables kept up to date have the intrinsic edges of new ones, and each edge at both ends") {
    Random random{std::mt19937(5)};
    for (const Shape& shape : shapes()) {
        Mesh mesh = shape.mesh;
        SurfaceTables tables = make_surface_tables(mesh.triangles, mesh.positions);
        REQUIRE(spokes_without_return(tables.fans) == 0);
        for (int round = 0; round < 6; ++round) {
            RefinedMesh refined = refined_somewhere(mesh, 1 + random.below(30), random);
            mesh = std::move(refined.mesh);
            SurfaceChange change;
            INFO(shape.name << " round " << round);
            REQUIRE(update_surface_tables(tables, mesh.triangles, mesh.positions, refined.roots, change));
            const SurfaceTables fresh = make_surface_tables(mesh.triangles, mesh.positions);
            CHECK(different_vertices(tables, fresh) == 0);
            CHECK(spokes_without_return(tables.fans) == 0);
            CHECK(tables.graph.longest_side >= fresh.graph.longest_side);
            CHECK(tables.fans.mean_length == Approx(fresh.fans.mean_length).epsilon(1e-6));
        }
    }
}

TEST_CASE("the work of an update is that of the change, whatever the size of the mesh") {
    // The same hole and the same points in a sheet of 40 x 40 cells and in one of 160 x 160.
    const auto touched = [](int cells) {
        Mesh mesh = plane(cells, cells, cells, cells, 0.0);
        for (Vec3& p : mesh.positions) {
            const Vec3 q = p; // by place, so that both sheets are alike near the corner
            p += 0.3 * Vec3(std::sin(13 * q.x + 7 * q.y), std::sin(11 * q.x - 5 * q.y), 0);
        }
        for (size_t i = 0; i < mesh.triangles.size(); i += 2) {
            const auto a = static_cast<uint32_t>(i / 2 / cells * (cells + 1) + i / 2 % cells);
            const uint32_t b = a + 1, c = a + cells + 2, d = a + cells + 1;
            mesh.triangles[i] = {a, b, c};
            mesh.triangles[i + 1] = {a, c, d};
        }
        mesh = from_triangles(mesh.positions, mesh.triangles);
        GeodesicSolver solver(mesh, mesh.positions);
        std::vector<SurfacePoint> points;
        for (int y = 8; y < 11; ++y) {
            for (int x = 8; x < 11; ++x) {
                points.push_back(
                    {static_cast<uint32_t>(2 * (y * cells + x)), Vec3(0.3, 0.25, 0.45), no_index});
            }
        }
        const RefinedMesh refined = make_vertices(mesh, points).refined;
        return solver.update(refined.mesh, refined.mesh.positions, refined.roots);
    };
    const SolverUpdate small = touched(40), large = touched(160);
    REQUIRE_FALSE(small.whole);
    CHECK(small.triangles == large.triangles);
    CHECK(small.flipped == large.flipped);
    CHECK(small.vertices == large.vertices);
    CHECK(small.triangles > 36);
    CHECK(small.flipped < 8 * small.triangles);
    CHECK(small.vertices < 2 * small.triangles);
}

TEST_CASE("what an update does not touch stays as it was, bit for bit") {
    Random random{std::mt19937(3)};
    Mesh mesh = bumps(60, 0.1);
    SurfaceTables tables = make_surface_tables(mesh.triangles, mesh.positions);
    const SurfaceTables before = tables;
    const RefinedMesh refined = refined_somewhere(mesh, 12, random);
    SurfaceChange change;
    REQUIRE(
        update_surface_tables(tables, refined.mesh.triangles, refined.mesh.positions, refined.roots, change));
    size_t same = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto row = [v](const FanTable& table) {
            return std::span(table.spokes.data() + table.fans[v].first_spoke,
                             table.spokes.data() + table.fans[v + 1].first_spoke);
        };
        const auto one = row(before.fans), two = row(tables.fans);
        same += before.fans.fans[v].total == tables.fans.fans[v].total &&
                        std::equal(one.begin(), one.end(), two.begin(), two.end(),
                                   [](const Spoke& a, const Spoke& b) {
                                       return a.vertex == b.vertex && a.length == b.length &&
                                              a.direction == b.direction && a.back == b.back &&
                                              a.cosine == b.cosine && a.sine == b.sine;
                                   })
                    ? 1
                    : 0;
    }
    // The rim's spokes learn new directions at the vertices that changed.
    CHECK(same + 3 * change.fans > mesh.vertex_count());
    CHECK(same < mesh.vertex_count());
    CHECK(change.fans < 200);
}

TEST_CASE("an update without a change changes nothing, and one beyond recognition makes all anew") {
    const Mesh mesh = bumps(30, 0.1), other = bumps(30, 0.2), smaller = bumps(20, 0.1);
    GeodesicSolver solver(mesh, mesh.positions);
    const SolverUpdate none = solver.update(mesh, mesh.positions);
    CHECK_FALSE(none.whole);
    CHECK(none.triangles + none.flipped + none.vertices == 0);
    const std::vector<SurfacePoint> source = {vertex_source(0)};
    for (const Mesh* next : {&other, &smaller, &mesh}) {
        CHECK(solver.update(*next, next->positions).whole);
        CHECK(solver.solve(source).dense(next->vertex_count()) ==
              GeodesicSolver(*next, next->positions).solve(source).dense(next->vertex_count()));
    }
}

TEST_CASE("marches go on over the surface that they began on when their solver is updated") {
    Mesh mesh = bumps(30, 0.1);
    Random random{std::mt19937(8)};
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        GeodesicSolver solver(mesh, mesh.positions);
        GeodesicMarch march = solver.march(method);
        march.add({{vertex_source(100)}, {}, {}});
        march.grow(0.2);
        const std::vector<double> whole =
            solver.solve(std::vector<SurfacePoint>{vertex_source(100)}, infinity, method)
                .dense(mesh.vertex_count());
        const RefinedMesh refined = refined_somewhere(mesh, 10, random);
        CHECK_FALSE(solver.update(refined.mesh, refined.mesh.positions, refined.roots).whole);
        march.grow(infinity);
        CHECK(march.field().dense(mesh.vertex_count()) == whole);
    }
}
