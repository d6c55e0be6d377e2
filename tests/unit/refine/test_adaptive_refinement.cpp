#include "engine/core/log.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/mesh/triangle_angles.h"
#include "tests/support/forging.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/refine_checks.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

struct Refined {
    RefinedMesh mesh;
    std::vector<HandleField> handles;
    RefineReport report;
};

Refined refined(const Mesh& mesh, std::vector<HandleField> handles, const RefineOptions& options) {
    Progress progress;
    const auto criterion = make_shape_criterion();
    Refinement result =
        refine(mesh.triangles, state_of(mesh, std::move(handles)), *criterion, options, progress);
    return {divided(mesh, result.state.parents, result.faces), std::move(result.state.handles),
            result.report};
}

/// A plane of 200 triangles (the sample is a regular grid) whose inner vertices are shaken.
Mesh coarse_plane() {
    Mesh mesh = make_sample("plane", 121);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shake(-0.025, 0.025);
    for (Vec3& p : mesh.positions) {
        if (std::max(std::abs(p.x), std::abs(p.y)) < 0.49) {
            p += Vec3(shake(random), shake(random), 0);
        }
    }
    triangulate(mesh);
    return mesh;
}

void check_surface(const Mesh& before, const RefinedMesh& after) {
    REQUIRE(after.mesh.vertex_count() == before.vertex_count() + after.parents.size());
    for (const Vec3& p : after.mesh.positions) {
        REQUIRE(is_finite(p));
    }
    for (size_t v = 0; v < before.vertex_count(); ++v) {
        REQUIRE(after.mesh.positions[v] == before.positions[v]);
    }
    const MeshFacts old_facts = facts_of(before);
    const MeshFacts facts = facts_of(after.mesh);
    CHECK(facts.euler == old_facts.euler);
    CHECK(facts.non_manifold_edges == old_facts.non_manifold_edges);
    CHECK(facts.bow_tie_vertices == old_facts.bow_tie_vertices);
    CHECK(facts.isolated_vertices == old_facts.isolated_vertices);
    CHECK(facts.components == old_facts.components);
    CHECK(count_flipped(before, after) == 0);
    // Sums of some thousand terms, each rounded to 1e-16 of the total.
    CHECK(area_of(after.mesh) == Approx(area_of(before)).epsilon(1e-12));
    CHECK(facts.volume == Approx(old_facts.volume).epsilon(1e-12).margin(1e-14));
    CHECK(boundary_length(after.mesh) == Approx(boundary_length(before)).epsilon(1e-12));
}

/// Per vertex the least angle of the triangles around it, in degrees.
std::vector<double> least_angles_around(const Mesh& mesh) {
    std::vector<double> angles(mesh.vertex_count(), 180);
    for (const Triangle& t : mesh.triangles) {
        const double angle = least_angle_of(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        for (const uint32_t v : t) {
            angles[v] = std::min(angles[v], glm::degrees(angle));
        }
    }
    return angles;
}

} // namespace

TEST_CASE("After refinement every edge is within the tolerance, and the surface is what it was") {
    std::mt19937 random(11);
    const std::vector<Mesh> meshes{coarse_plane(), make_sample("icosphere", 162), make_sample("torus", 200),
                                   make_sample("cube", 150), make_sample("hand", 600)};
    const std::vector<std::string> presets = preset_names();
    for (int trial = 0; trial < 40; ++trial) {
        const Mesh& mesh = meshes[trial % meshes.size()];
        const double size = bounds(mesh).diagonal();
        std::uniform_int_distribution<uint32_t> vertex(0, static_cast<uint32_t>(mesh.vertex_count() - 1));
        std::uniform_real_distribution<double> radius(0.05 * size, 0.3 * size);
        std::vector<HandleField> handles;
        const int count = 1 + trial % 3;
        for (int h = 0; h < count; ++h) {
            const std::vector<uint32_t> anchors = trial % 4 == 3
                                                      ? std::vector<uint32_t>{vertex(random), vertex(random)}
                                                      : std::vector<uint32_t>{vertex(random)};
            handles.push_back(field_from(mesh, anchors, presets[random() % presets.size()], radius(random)));
        }
        const double tolerance = trial % 2 == 0 ? 0.02 : 0.05;
        const Refined result = refined(mesh, handles, {tolerance, 0, 200000});
        INFO("trial " << trial << " added " << result.report.added << " rounds " << result.report.rounds);
        CHECK(result.report.stopped_by == RefineStop::tolerance);
        check_surface(mesh, result.mesh);
        CHECK(result.report.max_error <= tolerance);
        // The search for extrema leaves at most a few per cent (test_edge_error).
        CHECK(sampled_error(result.mesh.mesh, result.handles, 60) <= tolerance * 1.02);
    }
}

TEST_CASE("The rims of a cone and of a plateau on coarse meshes are closed chains of edges") {
    const Mesh plane = coarse_plane();
    const Mesh sphere = make_sample("icosphere", 162);
    for (const Mesh* mesh : {&plane, &sphere}) {
        const uint32_t centre = nearest_vertex(*mesh, {0, 0, 1});
        const double radius = mesh == &plane ? 0.3 : 0.7;
        for (const std::string preset : {"linear", "plateau"}) {
            const Refined result =
                refined(*mesh, {field_from(*mesh, {centre}, preset, radius)}, {0.01, 0, 100000});
            check_surface(*mesh, result.mesh);
            for (const double t : preset == "linear" ? std::vector<double>{1} : std::vector<double>{0.9, 1}) {
                const Rim rim = rim_of(result.mesh.mesh, result.handles[0], t * radius, 1e-6 * radius);
                INFO(preset << " at " << t << ", edges " << rim.edges);
                CHECK(rim.edges > 12);
                CHECK(rim.odd_vertices == 0);
                CHECK(rim.crossed_triangles == 0);
                CHECK(rim.farthest <= 1e-6 * radius);
            }
            if (mesh == &plane) {
                // On the plane the distance is that through space.
                for (uint32_t v = 0; v < result.mesh.mesh.vertex_count(); ++v) {
                    const double d = result.handles[0].distance(v);
                    const double straight =
                        glm::distance(result.mesh.mesh.positions[v], plane.positions[centre]);
                    CHECK((std::isfinite(d) ? std::abs(d - straight) : 0) <= 1e-9 * radius);
                }
            }
        }
    }
}

TEST_CASE("Flips make angles larger and break neither tolerance nor rim nor surface") {
    const Mesh plane = coarse_plane();
    const Mesh sphere = make_sample("icosphere", 162);
    for (const Mesh* mesh : {&plane, &sphere}) {
        const HandleField handle =
            field_from(*mesh, {nearest_vertex(*mesh, {0, 0, 1})}, "plateau", mesh == &plane ? 0.3 : 0.7);
        RefineOptions options{0.01, 0, 100000};
        const Refined plain = refined(*mesh, {handle}, options);
        options.flip = true;
        const Refined flipped = refined(*mesh, {handle}, options);
        CHECK(flipped.report.added == plain.report.added);
        CHECK(flipped.mesh.mesh.triangles != plain.mesh.mesh.triangles);
        check_surface(*mesh, flipped.mesh);
        CHECK(sampled_error(flipped.mesh.mesh, flipped.handles, 60) <= 0.01 * 1.02);
        const Rim rim =
            rim_of(flipped.mesh.mesh, flipped.handles[0], 0.9 * handle.radius, 1e-6 * handle.radius);
        CHECK(rim.odd_vertices == 0);
        CHECK(rim.crossed_triangles == 0);
        CHECK(facts_of(flipped.mesh.mesh).min_angle >= facts_of(plain.mesh.mesh).min_angle);
    }
}

TEST_CASE("Relaxation makes angles larger and moves neither old vertices nor rims nor the surface") {
    const Mesh plane = coarse_plane();
    const Mesh sphere = make_sample("icosphere", 162);
    for (const int variant : {0, 1, 2, 3, 4, 5, 6, 7}) {
        const Mesh& mesh = (variant & 1) == 0 ? plane : sphere;
        const std::string preset = (variant & 2) == 0 ? "plateau" : "wave";
        const double radius = (variant & 1) == 0 ? 0.3 : 0.7;
        const HandleField handle = field_from(mesh, {nearest_vertex(mesh, {0, 0, 1})}, preset, radius);
        RefineOptions options{0.01, 0, 100000, (variant & 4) != 0};
        const Refined plain = refined(mesh, {handle}, options);
        options.relax = true;
        const Refined relaxed = refined(mesh, {handle}, options);
        REQUIRE(relaxed.report.added == plain.report.added);
        REQUIRE(relaxed.mesh.mesh.triangles == plain.mesh.mesh.triangles);
        check_surface(mesh, relaxed.mesh);
        CHECK(relaxed.report.max_error <= 0.01);
        CHECK(sampled_error(relaxed.mesh.mesh, relaxed.handles, 60) <= 0.01 * 1.02);
        const std::vector<double> angles_before = least_angles_around(plain.mesh.mesh);
        const std::vector<double> angles_after = least_angles_around(relaxed.mesh.mesh);
        double gain = 0;
        size_t moved = 0;
        for (size_t i = 0; i < plain.mesh.parents.size(); ++i) {
            const VertexParents& p = relaxed.mesh.parents[i];
            const VertexParents& before = plain.mesh.parents[i];
            CHECK((p.a == before.a && p.b == before.b && p.place > 0 && p.place < 1));
            const auto v = static_cast<uint32_t>(mesh.vertex_count() + i);
            if (p.place != before.place) {
                ++moved;
                gain += angles_after[v] - angles_before[v];
            }
            for (const double t : {0.9, 1.0}) {
                const double off = plain.handles[0].distance(v) - t * radius;
                CHECK((preset == "wave" || p.place == before.place || std::abs(off) > 1e-6 * radius));
            }
        }
        INFO(preset << ", flips " << options.flip << ": moved " << moved << " of " << plain.report.added
                    << ", degrees " << gain / static_cast<double>(moved));
        CHECK(moved > plain.report.added / 50);
        CHECK(facts_of(relaxed.mesh.mesh).min_angle >= facts_of(plain.mesh.mesh).min_angle);
        CHECK(gain > 0.5 * static_cast<double>(moved));
    }
}

// Takes minutes; run by its tag. ANVIL_TEST_MESHES names a folder of further meshes.
TEST_CASE("A thousand random edits leave every edge within the tolerance", "[.thousand]") {
    std::vector<Mesh> meshes{make_sample("icosphere", 642), make_sample("torus", 500),
                             make_sample("cube", 300),      make_sample("hand", 2000),
                             make_sample("bust", 1500),     coarse_plane()};
    if (const char* folder = std::getenv("ANVIL_TEST_MESHES")) {
        for (const auto& file : std::filesystem::directory_iterator(folder)) {
            Log log;
            if (file.path().extension() != ".md" && file.file_size() < 1'000'000) {
                meshes.push_back(read_mesh(file.path(), log));
            }
        }
    }
    std::mt19937 random(12);
    size_t added = 0;
    size_t most_rounds = 0;
    int longest_trial = 0;
    double worst = 0;
    double least_piece = 1;
    for (int trial = 0; trial < 1000; ++trial) {
        const Mesh& mesh = meshes[trial % meshes.size()];
        const double size = bounds(mesh).diagonal();
        std::uniform_int_distribution<uint32_t> triangle(0, static_cast<uint32_t>(mesh.triangles.size() - 1));
        std::uniform_real_distribution<double> radius(0.03 * size, 0.15 * size);
        std::vector<HandleField> handles;
        for (int h = 0; h <= trial % 3; ++h) {
            std::vector<uint32_t> anchors(trial % 4 == 3 ? 2 : 1);
            for (uint32_t& anchor : anchors) {
                anchor = mesh.triangles[triangle(random)][0];
            }
            const double r = radius(random);
            handles.push_back(field_from(mesh, anchors, preset_names()[random() % preset_names().size()], r));
        }
        const double tolerance = trial % 2 == 0 ? 0.02 : 0.05;
        const Refined result = refined(mesh, handles, {tolerance, 0, 10'000'000});
        INFO("trial " << trial << " mesh " << trial % meshes.size() << " added " << result.report.added);
        CHECK(result.report.stopped_by == RefineStop::tolerance);
        CHECK(count_flipped(mesh, result.mesh) == 0);
        const MeshFacts before = facts_of(mesh);
        const MeshFacts after = facts_of(result.mesh.mesh);
        if (before.non_manifold_edges == 0) {
            // Pieces of an edge that is met too often are counted each, and two faces on the same corners
            // share the edges that divide them.
            CHECK(after.euler == before.euler);
            CHECK(after.non_manifold_edges == 0);
        }
        CHECK(area_of(result.mesh.mesh) == Approx(area_of(mesh)).epsilon(1e-12));
        CHECK(after.volume == Approx(before.volume).epsilon(1e-11).margin(1e-12 * size * size * size));
        CHECK(boundary_length(result.mesh.mesh) == Approx(boundary_length(mesh)).epsilon(1e-12));
        const double error = sampled_error(result.mesh.mesh, result.handles, 50) / tolerance;
        CHECK(error <= 1.02);
        worst = std::max(worst, error);
        added += result.report.added;
        if (result.report.rounds > most_rounds) {
            most_rounds = result.report.rounds;
            longest_trial = trial;
        }
        for (const VertexParents& p : result.mesh.parents) {
            least_piece = std::min({least_piece, p.place, 1 - p.place});
        }
    }
    WARN("added " << added << ", rounds at most " << most_rounds << " in trial " << longest_trial
                  << ", error at most " << worst << " of the tolerance, least piece " << least_piece);
}
