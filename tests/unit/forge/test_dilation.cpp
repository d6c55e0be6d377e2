// Contact dilation: what an occluder pushes away swells up beside it.
#include "engine/core/error.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// A ball of radius 0.4 pressed 0.3 deep into the top of a unit sphere.
Recipe pressed_sphere(const std::string& dilation, const std::string& more = "") {
    return recipe_of(
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': "
        "0.4}}, 'influence': {'kind': 'hard'}} ], 'edits': [ {'kind': 'translate', 'occluders': [ "
        "{'name': 'ball', 'motion': [ {'at': 0, 'translate': [0,1.6,0]}, {'at': 1, 'translate': "
        "[0,1.1,0]} ]} ]" +
        more + (dilation.empty() ? "" : ", 'dilation': " + dilation) + "} ] }");
}

/// A finger of a block pushed sideways at a standing capsule.
Recipe pushed_at_capsule(const std::string& dilation) {
    return recipe_of(
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'pole', 'shape': {'capsule': {'radius': 0.2, "
        "'height': 3}}, 'transform': {'translate': [1.3,0,0]}, 'influence': {'kind': 'hard'}} ], 'edits': [ "
        "{'kind': "
        "'translate', 'radius': 1.4, 'handles': [{'at': {'nearest': [1,0,0]}, 'by': [0.5,0,0]}], "
        "'dilation': " +
        dilation + "} ] }");
}

double volume_error(const ForgeResult& result) {
    const VolumeChange& volume = *result.report.edits[0].volume;
    return std::abs(volume.after / *volume.without_occluders - 1);
}

void check_outside(const ForgeResult& result, const Vec3& centre, double radius) {
    for (const Vec3& p : result.positions) {
        REQUIRE(is_finite(p));
        REQUIRE(glm::length(p - centre) >= radius - 1e-9);
    }
}

} // namespace

TEST_CASE("dilation solved for volume keeps it to a thousandth, whatever pushes") {
    const Mesh mesh = make_sample("sphere", 4000);
    const auto plain = forged_on_cpu(mesh, pressed_sphere(""));
    const auto kept = forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'solve': true, 'width': 0.6}"));
    CHECK(plain.report.edits[0].volume->after < 0.99 * plain.report.edits[0].volume->before);
    CHECK(kept.report.edits[0].volume->without_occluders == Approx(kept.report.edits[0].volume->before));
    CHECK(volume_error(kept) < 1e-4); // promised are 1e-3
    check_outside(kept, Vec3(0, 1.1, 0), 0.4);

    const auto pushed = forged_on_cpu(mesh, pushed_at_capsule("{'form': 'volume', 'solve': true}"));
    CHECK(pushed.report.edits[0].contact->contact_vertices > 20);
    CHECK(*pushed.report.edits[0].volume->without_occluders > 1.01 * pushed.report.edits[0].volume->before);
    CHECK(volume_error(pushed) < 1e-4);
    CHECK(pushed.report.edits[0].contact->penetrating_vertices == 0);
    CHECK(pushed.report.warnings.empty());
}

TEST_CASE("a mesh that faces inwards swells outwards too") {
    Mesh mesh = make_sample("sphere", 2000);
    const auto outward =
        forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'solve': true, 'width': 0.6}"));
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
    const auto inward =
        forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'solve': true, 'width': 0.6}"));
    CHECK(inward.report.edits[0].volume->after < 0);
    CHECK(volume_error(inward) < 1e-4);
    double largest = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        largest = std::max(largest, glm::length(inward.positions[v] - outward.positions[v]));
    }
    // The volume is solved to 1e-7, and approximate distances depend on the order of corners a little.
    CHECK(largest < 1e-5);
}

TEST_CASE("all of the pushed volume comes back by the volume form of amount 1, to first order") {
    const Mesh mesh = make_sample("sphere", 4000);
    const auto plain = forged_on_cpu(mesh, pressed_sphere(""));
    const auto half = forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'amount': 0.5, 'width': 0.6}"));
    const auto full = forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'amount': 1, 'width': 0.6}"));
    const double lost = plain.report.edits[0].volume->before - plain.report.edits[0].volume->after;
    const auto back = [&](const ForgeResult& result) {
        return (result.report.edits[0].volume->after - plain.report.edits[0].volume->after) / lost;
    };
    CHECK(back(full) == Approx(1).margin(0.1));
    CHECK(back(half) == Approx(0.5).margin(0.05));
}

TEST_CASE("dilation of amount 0 is none, and it stays within its width of contact and occluder") {
    const Mesh mesh = make_sample("sphere", 3000);
    // In as many equal steps as dilation takes, so that both take the same ones.
    const auto plain = forged_on_cpu(mesh, pressed_sphere(""));
    const auto none = forged_on_cpu(mesh, pressed_sphere("{'form': 'depth', 'amount': 0}"));
    const auto some = forged_on_cpu(mesh, pressed_sphere("{'form': 'depth', 'amount': 0.5, 'width': 0.4}"));
    size_t swollen = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        // Steps end where passes end: adaptive steps are others, their error is second order in h = 5e-3.
        REQUIRE(glm::length(none.positions[v] - plain.positions[v]) < 1e-3);
        const Vec3& start = mesh.positions[v];
        const bool raised = glm::length(some.positions[v]) > 1 + 1e-3;
        swollen += raised ? 1 : 0;
        if (glm::length(start - Vec3(0, 1.1, 0)) > 0.4 + 0.5 + 0.4) { // the way, the ball and the width
            REQUIRE(some.positions[v] == start);
        }
    }
    CHECK(swollen > 50);
    check_outside(some, Vec3(0, 1.1, 0), 0.4);
    CHECK(some.report.edits[0].dilation->height > 0.1); // of 0.3 deep, half, while it deepens
    CHECK(some.report.edits[0].dilation->height < 0.25);
}

TEST_CASE("dilation converges with the number of its steps") {
    const Mesh mesh = make_sample("sphere", 2000);
    std::vector<ForgeResult> results;
    for (const char* steps : {"8", "16", "32", "64"}) {
        results.push_back(
            forged_on_cpu(mesh, pressed_sphere("{'form': 'volume', 'amount': 1, 'width': 0.6}",
                                               std::string(", 'steps': {'count': ") + steps + "}")));
    }
    const auto rms = [&](const ForgeResult& a, const ForgeResult& b) {
        double sum = 0;
        for (size_t v = 0; v < a.positions.size(); ++v) {
            sum += glm::dot(a.positions[v] - b.positions[v], a.positions[v] - b.positions[v]);
        }
        return std::sqrt(sum / static_cast<double>(a.positions.size()));
    };
    const double first = rms(results[0], results[1]);
    const double second = rms(results[1], results[2]);
    const double third = rms(results[2], results[3]);
    INFO(first << " " << second << " " << third);
    CHECK(second < 0.8 * first);
    CHECK(third < 0.8 * second);
}

TEST_CASE("an open mesh dilates by an amount, and has no volume to solve for") {
    const Mesh mesh = make_sample("plane", 2000);
    const std::string press =
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': "
        "{'radius': 0.15}}, 'influence': {'kind': 'hard'}} ], 'edits': [ {'kind': 'translate', "
        "'occluders': [ {'name': 'ball', 'motion': [ {'at': 0, 'translate': [0,0,0.3]}, {'at': "
        "1, 'translate': [0,0,0.08]} ]} ], 'dilation': ";
    const auto raised =
        forged_on_cpu(mesh, recipe_of(press + "{'form': 'depth', 'amount': 0.5, 'width': 0.15}} ] }"));
    double highest = 0;
    for (const Vec3& p : raised.positions) {
        highest = std::max(highest, p.z);
    }
    CHECK(highest > 0.005);
    CHECK(highest < 0.07);
    CHECK_FALSE(raised.report.edits[0].volume);
    CHECK_THROWS_WITH(forged_on_cpu(mesh, recipe_of(press + "{'form': 'volume', 'solve': true}} ] }")),
                      Catch::Contains("edits[0].dilation") && Catch::Contains("open"));
}
