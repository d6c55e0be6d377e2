#include "app/viewer/coarse_triangles.h"
#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>
#include <set>

using namespace anvil;

TEST_CASE("less detail: so many triangles as were asked for, on the surface's own vertices") {
    const Mesh mesh = make_sample("icosphere", 40962);
    for (const size_t count : {2000U, 10000U}) {
        const std::vector<uint32_t> corners = coarse_triangles(mesh.positions, mesh.triangles, count);
        const size_t found = corners.size() / 3;
        REQUIRE(corners.size() % 3 == 0);
        CHECK(found >= count / 2);
        CHECK(found <= 2 * count);
        std::set<std::array<uint32_t, 3>> known;
        double area = 0;
        double volume = 0;
        for (size_t i = 0; i < corners.size(); i += 3) {
            const std::array<uint32_t, 3> t{corners[i], corners[i + 1], corners[i + 2]};
            CHECK(known.insert(t).second);
            const Vec3& a = mesh.positions.at(t[0]);
            const Vec3& b = mesh.positions.at(t[1]);
            const Vec3& c = mesh.positions.at(t[2]);
            area += 0.5 * glm::length(glm::cross(b - a, c - a));
            volume += glm::dot(a, glm::cross(b, c)) / 6;
        }
        // Still closed and the same way round: the volume misses a ball's by what chords of a cube's width w
        // cut off, about w * w / 4 of it at most, w * w = 2 * 4 pi / count.
        const double slack = 2 * 4 * 3.1416 / static_cast<double>(count);
        CHECK(volume == Approx(4.18879).epsilon(slack));
        CHECK(area >= 12.566 * (1 - slack));
        CHECK(area <= 12.566 * 1.1);
    }
}

TEST_CASE("less detail of nothing, of one place and with places that are not finite") {
    CHECK(coarse_triangles({}, {}, 100).empty());
    const std::vector<Vec3> same(3, Vec3(1));
    const std::vector<Triangle> one{{0, 1, 2}};
    CHECK(coarse_triangles(same, one, 100).empty());
    const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {infinity, 0, 0}};
    const std::vector<Triangle> two{{0, 1, 2}, {0, 1, 3}};
    CHECK(coarse_triangles(places, two, 100) == std::vector<uint32_t>{0, 1, 2});
}
