#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/solid.h"
#include "engine/occluder/surface_sides.h"
#include "tests/support/contact_scene.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace anvil;
using test::random_in;

namespace {

void append(Mesh& mesh, const Mesh& other, const Vec3& by, double scale = 1) {
    const auto offset = static_cast<uint32_t>(mesh.vertex_count());
    for (const Vec3& p : other.positions) {
        mesh.positions.push_back(scale * p + by);
    }
    for (size_t f = 0; f < other.polygon_count(); ++f) {
        std::vector<uint32_t> corners;
        for (const uint32_t v : other.polygon(f)) {
            corners.push_back(v + offset);
        }
        mesh.add_polygon(corners);
    }
    mesh.triangles.clear();
    triangulate(mesh);
}

/// Two balls that reach into each other.
Mesh overlapping_balls() {
    Mesh mesh = make_sample("icosphere", 642);
    append(mesh, make_sample("icosphere", 642), Vec3(0.9, 0.11, 0.07), 0.8);
    return mesh;
}

void turn_over(Mesh& mesh) {
    Mesh turned;
    turned.positions = mesh.positions;
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        std::vector<uint32_t> corners(mesh.polygon(f).begin(), mesh.polygon(f).end());
        std::reverse(corners.begin(), corners.end());
        turned.add_polygon(corners);
    }
    triangulate(turned);
    mesh = turned;
}

struct Told {
    size_t told = 0;
    size_t wrong = 0;
};

/// How often the nearest face tells the winding number, and how often it is not that of all faces.
Told told_by_faces(const Mesh& mesh, size_t count) {
    const SearchTree tree(mesh.positions, mesh.triangles);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    const SurfaceSides sides(mesh.positions, mesh.triangles, tree, winding);
    const Box box = bounds(mesh);
    std::mt19937 random(1);
    Told result;
    for (size_t i = 0; i < count; ++i) {
        const Vec3 p = random_in(random, box.low - Vec3(0.1), box.high + Vec3(0.1));
        if (const auto told = sides.winding(p, tree.closest(p))) {
            ++result.told;
            result.wrong += *told != std::lround(winding.at(p)) ? 1 : 0;
        }
    }
    return result;
}

std::vector<Crossing> crossings(const Mesh& mesh) {
    return find_crossings(mesh.positions, mesh.triangles, SearchTree(mesh.positions, mesh.triangles));
}

/// Corners in small whole numbers, which doubles compute with exactly.
using Corners = std::array<Vec3, 3>;

bool is_corner(const Vec3& p, const Corners& of) {
    return std::find(of.begin(), of.end(), p) != of.end();
}

enum class Parting {
    none,
    touching, ///< nothing of one lies beyond all of the other
    clear     ///< nor do they touch, but in common corners and the edge between these
};

Parting parting(const Vec3& axis, const Corners& a, const Corners& b) {
    auto result = Parting::clear;
    for (const Vec3& p : a) {
        for (const Vec3& q : b) {
            const double gap = glm::dot(axis, q - p);
            const bool common = is_corner(p, b) && is_corner(q, a);
            const Parting here = gap > 0 || (gap == 0 && common) ? Parting::clear
                                 : gap == 0                      ? Parting::touching
                                                                 : Parting::none;
            result = std::min(result, here);
        }
    }
    return result;
}

/// By the axes that are enough for convex bodies: across faces, and across an edge of each.
Parting parting(const Corners& a, const Corners& b) {
    std::vector<Vec3> axes;
    const auto edge = [](const Corners& t, int i) { return t[(i + 1) % 3] - t[i]; };
    for (const Corners& t : {a, b}) {
        const Vec3 normal = glm::cross(edge(t, 0), edge(t, 1));
        axes.push_back(normal);
        for (int i = 0; i < 3; ++i) {
            axes.push_back(glm::cross(normal, edge(t, i)));
            for (int j = 0; j < 3; ++j) {
                axes.push_back(glm::cross(edge(a, i), edge(b, j)));
            }
        }
    }
    auto best = Parting::none;
    for (const Vec3& axis : axes) {
        if (axis != Vec3(0)) {
            best = std::max({best, parting(axis, a, b), parting(-axis, a, b)});
        }
    }
    return best;
}

std::string warnings_of(const Mesh& mesh) {
    const ScratchFolder folder;
    write_mesh(folder / "tool.ply", mesh, mesh.positions);
    Log log;
    solid_distance(OccluderShape{MeshShape{"tool.ply"}}, {folder.path(), &log});
    std::string all;
    for (const std::string& warning : log.warnings) {
        all += warning + "\n";
    }
    return all;
}

} // namespace

TEST_CASE("on sound surfaces the nearest face tells the winding number of nearly all points, and rightly") {
    Mesh inverted = make_sample("torus", 1000);
    turn_over(inverted);
    for (const Mesh& mesh : {make_sample("torus", 1000), make_sample("cube", 600), make_sample("hand", 3000),
                             make_sample("bust", 3000), inverted}) {
        const Told told = told_by_faces(mesh, 4000);
        CHECK(told.wrong == 0);
        CHECK(told.told > 3900);
    }
}

TEST_CASE("where parts reach into each other the faces that do so tell nothing, and all others rightly") {
    const Told told = told_by_faces(overlapping_balls(), 4000);
    CHECK(told.wrong == 0);
    CHECK(told.told > 2000);
    CHECK(told.told < 4000);
}

TEST_CASE("on open, doubled or partly flipped surfaces the faces tell nothing wrong") {
    Mesh open = make_sample("icosphere", 642);
    open.triangles.pop_back();
    CHECK(told_by_faces(open, 500).told == 0);
    Mesh doubled = make_sample("icosphere", 642);
    append(doubled, make_sample("icosphere", 642), Vec3(0));
    CHECK(told_by_faces(doubled, 500).wrong == 0);
    Mesh flipped = make_sample("icosphere", 642);
    std::swap(flipped.triangles[5][0], flipped.triangles[5][1]);
    CHECK(told_by_faces(flipped, 500).wrong == 0);
}

TEST_CASE("triangles that pass through others are found, and only they") {
    const Mesh mesh = overlapping_balls();
    const std::vector<Crossing> found = crossings(mesh);
    size_t crossing = 0;
    for (size_t t = 0; t < found.size(); ++t) {
        // The balls' surfaces meet where both distances vanish; a triangle is up to 0.16 wide.
        bool near = false;
        for (const uint32_t v : mesh.triangles[t]) {
            const Vec3& p = mesh.positions[v];
            near = near || (std::abs(glm::length(p) - 1) < 0.17 &&
                            std::abs(glm::length(p - Vec3(0.9, 0.11, 0.07)) - 0.8) < 0.17);
        }
        crossing += found[t] == Crossing::crosses ? 1 : 0;
        CHECK((near || found[t] == Crossing::none));
    }
    // The circle is about 4.4 long, and both balls are cut along it by triangles at most 0.16 wide.
    CHECK(crossing > 50);
    for (const char* name : {"torus", "cube", "icosphere", "hand", "plane"}) {
        const std::vector<Crossing> sound = crossings(make_sample(name, 2000));
        CHECK(std::count(sound.begin(), sound.end(), Crossing::none) ==
              static_cast<std::ptrdiff_t>(sound.size()));
    }
}

TEST_CASE("two triangles cross, touch or miss each other") {
    const std::vector<Vec3> positions{{0, 0, 0},     {1, 0, 0},   {0, 1, 0},     {0.2, 0.2, -1},
                                      {0.2, 0.2, 1}, {3, 3, 0.5}, {0.2, 0.2, 0}, {0.9, 0.9, 0}};
    const auto of = [&](const Triangle& a, const Triangle& b) {
        const std::vector<Triangle> both{a, b};
        return find_crossings(positions, both, SearchTree(positions, both))[0];
    };
    CHECK(of({0, 1, 2}, {3, 4, 5}) == Crossing::crosses);
    CHECK(of({0, 1, 2}, {6, 4, 5}) == Crossing::unsure); // its corner lies in the first
    CHECK(of({0, 1, 2}, {0, 1, 4}) == Crossing::none);   // a common edge
    CHECK(of({0, 1, 2}, {1, 2, 7}) == Crossing::none);   // the same in one plane
    CHECK(of({0, 1, 2}, {1, 2, 6}) == Crossing::unsure); // folded onto it
    CHECK(of({0, 1, 2}, {0, 1, 2}) == Crossing::unsure);
    CHECK(of({0, 1, 2}, {0, 4, 5}) == Crossing::none); // a common corner
    CHECK(of({0, 1, 2}, {7, 4, 5}) == Crossing::none);
}

TEST_CASE("of any two triangles those that meet are found, and those that a plane parts are not") {
    std::mt19937 random(6);
    size_t parted = 0;
    size_t meeting = 0;
    for (uint32_t round = 0; round < 30000; ++round) {
        std::vector<Vec3> positions(6);
        for (Vec3& p : positions) {
            p = Vec3(random() % 6, random() % 6, random() % 6);
        }
        std::vector<Triangle> both{{0, 1, 2}, {3, 4, 5}};
        for (uint32_t shared = 0; shared < round % 3; ++shared) {
            positions[3 + shared] = positions[2 * shared];
            both[1][shared] = 2 * shared;
        }
        const Corners a{positions[0], positions[1], positions[2]};
        const Corners b{positions[3], positions[4], positions[5]};
        const bool flat = glm::cross(a[1] - a[0], a[2] - a[0]) == Vec3(0) ||
                          glm::cross(b[1] - b[0], b[2] - b[0]) == Vec3(0);
        const auto common = std::count_if(a.begin(), a.end(), [&](const Vec3& p) { return is_corner(p, b); });
        if (flat || common != round % 3) {
            continue;
        }
        const std::vector<Crossing> found = find_crossings(positions, both, SearchTree(positions, both));
        REQUIRE(found[0] == found[1]);
        const Parting truth = parting(a, b);
        if (truth != Parting::touching) {
            parted += truth == Parting::clear ? 1 : 0;
            meeting += truth == Parting::none ? 1 : 0;
            REQUIRE((found[0] == Crossing::none) == (truth == Parting::clear));
        }
    }
    CHECK(parted > 5000);
    CHECK(meeting > 1000);
}

TEST_CASE("which triangles cross does not depend on their numbers") {
    const Mesh mesh = overlapping_balls();
    const std::vector<Crossing> found = crossings(mesh);
    std::vector<uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(4));
    Mesh shuffled = mesh;
    std::transform(order.begin(), order.end(), shuffled.triangles.begin(),
                   [&](uint32_t t) { return mesh.triangles[t]; });
    const std::vector<Crossing> again = crossings(shuffled);
    for (size_t i = 0; i < order.size(); ++i) {
        CHECK(again[i] == found[order[i]]);
    }
}

TEST_CASE("distances traced along a path are those asked one by one") {
    const auto solid = mesh_distance(make_sample("bust", 2000));
    std::mt19937 random(2);
    std::vector<Vec3> points{Vec3(0)};
    for (int i = 0; i < 3000; ++i) {
        points.push_back(points.back() + random_in(random, Vec3(-0.1), Vec3(0.1)));
        if (i % 500 == 0) {
            points.push_back(random_in(random, Vec3(-2), Vec3(2)));
        }
    }
    std::vector<SignedDistance> traced(points.size());
    solid->tracer()->trace(points, traced);
    for (size_t i = 0; i < points.size(); ++i) {
        CHECK(traced[i].distance == solid->at(points[i]).distance);
    }
}

TEST_CASE("what is wrong with an occluder's mesh is said in words") {
    const Mesh whole = make_sample("icosphere", 642);
    CHECK(warnings_of(whole).empty());
    Mesh inverted = whole;
    turn_over(inverted);
    CHECK_THAT(warnings_of(inverted), Catch::Contains("point inwards"));
    Mesh open;
    open.positions = whole.positions;
    for (size_t f = 1; f < whole.polygon_count(); ++f) {
        open.add_polygon(whole.polygon(f));
    }
    triangulate(open);
    CHECK_THAT(warnings_of(open), Catch::Contains("open (1 hole, 3 edges)"));
    CHECK_THAT(warnings_of(overlapping_balls()), Catch::Contains("pass through others"));
    Mesh flipped;
    flipped.positions = whole.positions;
    for (size_t f = 0; f < whole.polygon_count(); ++f) {
        std::vector<uint32_t> corners(whole.polygon(f).begin(), whole.polygon(f).end());
        if (f == 7) {
            std::reverse(corners.begin(), corners.end());
        }
        flipped.add_polygon(corners);
    }
    triangulate(flipped);
    CHECK_THAT(warnings_of(flipped), Catch::Contains("flipped"));
    Mesh doubled = whole;
    doubled.add_polygon(std::vector<uint32_t>{whole.triangles[0][0], whole.triangles[0][1], 600});
    triangulate(doubled);
    CHECK_THAT(warnings_of(doubled), Catch::Contains("non-manifold"));
}
