#include "engine/mesh/sample_shapes.h"
#include "engine/mesh/search_tree.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/self_intersection.h"
#include "engine/occluder/side_anchors.h"
#include "engine/occluder/surface_sides.h"
#include "tests/support/contact_scene.h"
#include "tests/support/summed_winding.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace anvil;
using test::random_in;

namespace {

Mesh with(Mesh mesh, const Mesh& other, const Vec3& by, double scale) {
    const auto offset = static_cast<uint32_t>(mesh.vertex_count());
    for (const Vec3& p : other.positions) {
        mesh.positions.push_back(scale * p + by);
    }
    for (const Triangle& t : other.triangles) {
        mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    return mesh;
}

Mesh without_top(Mesh mesh, double height) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.positions[t[0]].y > height; });
    return mesh;
}

Mesh torn(Mesh mesh, unsigned one_in) {
    std::mt19937 random(8);
    std::erase_if(mesh.triangles, [&](const Triangle&) { return random() % one_in == 0; });
    return mesh;
}

/// Open, crossing and nested ones of about unit size around the origin.
std::vector<std::pair<std::string, Mesh>> awkward_meshes() {
    const Mesh ball = make_sample("icosphere", 642);
    const Mesh coarse = make_sample("icosphere", 42);
    const Mesh bowl = without_top(ball, 0.2);
    return {{"bowl", bowl},
            {"coarse bowl", without_top(coarse, 0.2)},
            {"bust without its head", without_top(make_sample("bust", 3000), 0.3)},
            {"torn torus", torn(make_sample("torus", 2000), 12)},
            {"sheet", make_sample("plane", 100)},
            {"balls through each other", with(coarse, ball, Vec3(0.9, 0.11, 0.07), 0.6)},
            {"bowls through each other", with(bowl, bowl, Vec3(0.31, 0.2, 0.07), 0.8)},
            {"bowl in a ball with another one through it",
             with(with(ball, coarse, Vec3(0.1), 1), bowl, Vec3(0), 0.5)}};
}

/// As a field's samples lie: lattices, finer and coarser ones, beside faces, holes and anywhere.
std::vector<Vec3> lattice(const Mesh& mesh, std::mt19937& random) {
    const Box box = bounds(mesh);
    const double step = 0.03 * box.diagonal() / static_cast<double>(1 << random() % 5);
    const Vec3 low = random() % 3 == 0
                         ? random_in(random, box.low, box.high)
                         : mesh.positions[mesh.triangles[random() % mesh.triangles.size()][random() % 3]];
    std::vector<Vec3> points;
    for (int i = 0; i < 9 * 9 * 9; ++i) {
        points.push_back(low + step * Vec3(i % 9 - 4, i / 9 % 9 - 4, i / 81 - 4));
    }
    return points;
}

struct Compared {
    size_t points = 0;
    size_t inside = 0;
    size_t different = 0;
};

/// A tracer's signs and those of winding numbers summed for each point. Nothing is inside beyond the bounds.
Compared compare(const Mesh& mesh, int lattices) {
    const auto solid = mesh_distance(mesh);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    const auto tracer = solid->tracer();
    const Box box = solid->bounds();
    std::mt19937 random(6);
    Compared result;
    for (int i = 0; i < lattices; ++i) {
        const std::vector<Vec3> points = lattice(mesh, random);
        std::vector<SignedDistance> found(points.size());
        tracer->trace(points, found);
        for (size_t k = 0; k < points.size(); ++k) {
            const Vec3& p = points[k];
            const bool within =
                glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
            const bool inside = within && std::abs(winding.at(p)) > 0.5;
            ++result.points;
            result.inside += inside ? 1 : 0;
            result.different += inside != std::signbit(found[k].distance) ? 1 : 0;
        }
    }
    return result;
}

SurfaceBoundary boundary_of(const Mesh& mesh) {
    const SearchTree tree(mesh.positions, mesh.triangles);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    return SurfaceBoundary(SurfaceSides(mesh.positions, mesh.triangles, tree, winding).take_boundary());
}

} // namespace

TEST_CASE("many points at once are on the sides that each one's own winding number tells") {
    size_t different = 0;
    size_t inside = 0;
    for (const auto& [name, mesh] : awkward_meshes()) {
        const Compared found = compare(mesh, 40);
        INFO(name << ": " << found.different << " of " << found.points << " differ");
        CHECK(found.different == 0);
        different += found.different;
        inside += found.inside;
    }
    CHECK(different == 0);
    CHECK(inside > 15'000); // of 230,000: both sides are there
}

TEST_CASE("they are far from the origin, and where meshes are tiny or huge") {
    for (const auto& [name, mesh] : awkward_meshes()) {
        for (const auto& [scale, by] :
             {std::pair(1.0, Vec3(1e6, -2e6, 3e5)), std::pair(1e-7, Vec3(0)), std::pair(1e8, Vec3(3e8))}) {
            Mesh moved = mesh;
            for (Vec3& p : moved.positions) {
                p = scale * p + by;
            }
            const Compared found = compare(moved, 12);
            INFO(name << " times " << scale << ": " << found.different << " of " << found.points
                      << " differ");
            CHECK(found.different == 0);
        }
    }
}

TEST_CASE("off the surface the winding number changes within reach by no more than was asked for") {
    for (const auto& [name, mesh] : awkward_meshes()) {
        const SearchTree tree(mesh.positions, mesh.triangles);
        const SurfaceBoundary boundary = boundary_of(mesh);
        const Box box = bounds(mesh);
        std::mt19937 random(2);
        double most = 0; // change, of what was asked for
        for (int i = 0; i < 250; ++i) {
            const Vec3 p = random_in(random, box.low - Vec3(0.2), box.high + Vec3(0.2));
            const double change = std::exp2(-1.0 - random() % 8);
            const double free = tree.closest(p).distance;
            const double reach = boundary.reach(p, change, 2 * free);
            REQUIRE(reach >= 0);
            REQUIRE(reach <= 2 * free);
            const Vec3 direction = glm::normalize(random_in(random, Vec3(-1), Vec3(1)));
            const double way = std::min(reach, 0.999999 * free);
            const double changed = std::abs(winding(mesh, p + way * direction) - winding(mesh, p));
            most = std::max(most, (changed - 1e-9) / change);
        }
        INFO(name << " changes by " << most << " of what was asked for");
        CHECK(most <= 1);
        // No boundary, no change; else it takes more than a twentieth of what it may.
        const bool closed = boundary.reach(Vec3(0), 1e-9, 1e9) == 1e9;
        CHECK((closed ? most <= 0 : most > 0.05));
    }
}

TEST_CASE("nothing is near enough where no change is allowed, and no boundary lets everything be") {
    const SurfaceBoundary boundary = boundary_of(make_sample("plane", 100));
    CHECK(boundary.reach(Vec3(0, 0, 1), 0, 1) == 0);
    CHECK(boundary.reach(Vec3(0, 0, 1), -1, 1) == 0);
    CHECK(boundary.reach(Vec3(0.5, 0.5, 0), 0.5, 1) == 0); // on it
    CHECK(boundary.reach(Vec3(0, 0, 1e9), 0.1, 1) == 1);
    CHECK(SurfaceBoundary().reach(Vec3(0), 1e-12, 7) == 7);
}

TEST_CASE("an edge bounds a surface if it has more faces one way round than the other, seams do not") {
    Mesh ball = make_sample("icosphere", 162);
    const auto edges = [](const Mesh& mesh) {
        const SearchTree tree(mesh.positions, mesh.triangles);
        const WindingNumber winding(mesh.positions, mesh.triangles);
        return SurfaceSides(mesh.positions, mesh.triangles, tree, winding).take_boundary();
    };
    CHECK(edges(ball).empty());
    Mesh apart; // each triangle has corners of its own
    for (const Triangle& t : ball.triangles) {
        const auto first = static_cast<uint32_t>(apart.positions.size());
        for (const uint32_t v : t) {
            apart.positions.push_back(ball.positions[v]);
        }
        apart.triangles.push_back({first, first + 1, first + 2});
    }
    CHECK(edges(apart).empty());
    ball.triangles.pop_back();
    CHECK(edges(ball).size() == 3);
    ball.triangles.push_back(ball.triangles.front()); // twice: its edges have one more one way
    const std::vector<BoundaryEdge> both = edges(ball);
    CHECK(both.size() == 6);
    CHECK(std::all_of(both.begin(), both.end(), [](const BoundaryEdge& e) { return e.excess == 1; }));
}

TEST_CASE("few points of a lattice around crossing surfaces take a winding number of their own") {
    const Mesh mesh = awkward_meshes()[5].second;
    const SearchTree tree(mesh.positions, mesh.triangles);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    const SurfaceBoundary boundary;
    SideAnchors anchors(winding, boundary, 1e-13);
    std::vector<std::pair<double, Vec3>> points;
    for (int i = 0; i < 21 * 21 * 21; ++i) {
        const Vec3 p = 0.025 * Vec3(i % 21, i / 21 % 21, i / 441);
        points.emplace_back(tree.closest(p).distance, p);
    }
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    size_t wrong = 0;
    for (const auto& [distance, p] : points) {
        wrong += anchors.inside(p, distance) != (std::abs(winding.at(p)) > 0.5) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(anchors.sums() < points.size() / 8);
}
