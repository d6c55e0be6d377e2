#include "engine/document/surface_difference.h"

#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>

using namespace anvil;

namespace {

SurfaceVersion sphere() {
    return first_version(std::make_shared<const Mesh>(make_sample("icosphere", 642)));
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

void check_same(const SurfaceVersion& a, const SurfaceVersion& b) {
    CHECK(same_bits(a.positions, b.positions));
    CHECK(a.weights == b.weights);
    CHECK(a.moved == b.moved);
    CHECK(a.touching == b.touching);
    CHECK(a.number == b.number);
    CHECK(a.mesh == b.mesh);
    CHECK(a.volume == b.volume);
    CHECK(a.warnings == b.warnings);
}

void check_leads_both_ways(const SurfaceVersion& before, const SurfaceVersion& after) {
    const auto change = difference(before, after);
    REQUIRE(change);
    SurfaceVersion made = before;
    apply(*change, made);
    check_same(made, after);
    take_back(*change, made);
    check_same(made, before);
}

} // namespace

TEST_CASE("a surface is put together from the one before it or after it, every bit of it") {
    const SurfaceVersion before = sphere();
    SurfaceVersion after = before;
    after.positions[3] += Vec3(0.1, 0, 0);
    after.positions[7].x = -0.0; // equal to the zero that may have been there, and another number
    after.positions[8].y = std::numeric_limits<double>::quiet_NaN();
    after.weights[5] = 0.5F;
    after.moved[3] = true;
    after.touching[600] = true;
    after.number = new_surface_number();
    after.volume = 3;
    after.warnings = {"something"};
    check_leads_both_ways(before, after);
    SurfaceVersion zero = after;
    zero.positions[7].x = 0.0;
    check_leads_both_ways(after, zero);
    CHECK(difference(after, zero)->vertices == std::vector<uint32_t>{7}); // NaN's bits are the same
}

TEST_CASE("a surface that refinement added vertices to is put together as well") {
    const SurfaceVersion before = sphere();
    SurfaceVersion after = before;
    Mesh more = *before.mesh;
    more.positions.emplace_back(0.25, 0.5, 0.75);
    after.mesh = std::make_shared<const Mesh>(more);
    after.positions.emplace_back(0.5, 0.5, 0.5);
    after.weights.push_back(0.25F);
    after.moved.push_back(true);
    after.touching.push_back(false);
    check_leads_both_ways(before, after);
    CHECK(difference(before, after)->vertices == std::vector<uint32_t>{642});
}

TEST_CASE(
    "what an edit of a tenth changes takes less than a quarter, and nothing is gained where all changes") {
    const SurfaceVersion before = sphere();
    SurfaceVersion after = before;
    for (size_t v = 0; v < 64; ++v) {
        after.positions[v] *= 1.1;
    }
    CHECK(own_bytes(*difference(before, after)) < 3 * sizeof(SurfaceVersion) + own_bytes(after) / 4);
    for (Vec3& p : after.positions) {
        p *= 1.1;
    }
    CHECK_FALSE(difference(before, after));
}
