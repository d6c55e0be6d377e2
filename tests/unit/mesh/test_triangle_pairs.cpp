#include "engine/mesh/sample_shapes.h"
#include "engine/mesh/triangle_pairs.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>
#include <set>

using namespace anvil;
using test::random_in;

namespace {

Box box_of(const Mesh& mesh, uint32_t triangle) {
    Box box;
    for (const uint32_t v : mesh.triangles[triangle]) {
        box.include(mesh.positions[v]);
    }
    return box;
}

/// Largest of the gaps along the axes; negative where the boxes overlap.
double gap(const Box& a, const Box& b) {
    const Vec3 gaps = glm::max(a.low - b.high, b.low - a.high);
    return std::max({gaps.x, gaps.y, gaps.z});
}

/// Triangles anywhere, of sizes from 1 down to 2^-10.
Mesh soup(size_t count) {
    std::mt19937 random(3);
    Mesh mesh;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 centre = random_in(random, Vec3(-1), Vec3(1));
        const double size = std::exp2(-static_cast<double>(i % 11));
        for (int corner = 0; corner < 3; ++corner) {
            mesh.positions.push_back(centre + size * random_in(random, Vec3(-1), Vec3(1)));
        }
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// Pairs that are missing, wrong or found twice.
size_t mistakes(const Mesh& mesh) {
    const SearchTree tree(mesh.positions, mesh.triangles);
    const TrianglePairs pairs(tree);
    std::set<std::pair<uint32_t, uint32_t>> found;
    size_t wrong = 0;
    for (size_t leaf = 0; leaf < pairs.leaf_count(); ++leaf) {
        pairs.each_of(leaf, [&](uint32_t slot, uint32_t other) {
            wrong += slot / 4 == leaf && slot < other && found.emplace(slot, other).second ? 0 : 1;
        });
    }
    const double nearly = 4e-7 * bounds(mesh).diagonal();
    for (uint32_t slot = 0; slot < tree.triangle_count(); ++slot) {
        for (uint32_t other = slot + 1; other < tree.triangle_count(); ++other) {
            const double apart = gap(box_of(mesh, tree.order()[slot]), box_of(mesh, tree.order()[other]));
            const bool is_found = found.contains({slot, other});
            wrong += apart <= 0 && !is_found ? 1 : 0;
            wrong += apart > nearly && is_found ? 1 : 0;
        }
    }
    return wrong;
}

} // namespace

TEST_CASE("of all triangles whose boxes touch each pair is found once, and none that are far apart") {
    CHECK(mistakes(soup(700)) == 0);
    CHECK(mistakes(soup(1)) == 0);
    CHECK(mistakes(Mesh{}) == 0);
    for (const char* name : {"torus", "cube", "plane"}) {
        CHECK(mistakes(make_sample(name, 400)) == 0);
    }
}

TEST_CASE("close triangles are found wherever the mesh lies and whatever its size") {
    for (const double scale : {1e-60, 1e60}) {
        Mesh mesh = soup(300);
        for (Vec3& p : mesh.positions) {
            p = scale * (p + Vec3(1e5, 0, -1e4));
        }
        CHECK(mistakes(mesh) == 0);
    }
    Mesh point = soup(9);
    std::fill(point.positions.begin(), point.positions.end(), Vec3(3));
    CHECK(mistakes(point) == 0);
}
