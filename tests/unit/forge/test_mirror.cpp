#include "engine/forge/drag_session.h"
#include "tests/support/forging.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

Vec3 image(const Vec3& p) {
    return {-p.x, p.y, p.z};
}

/// A bumpy sheet over [-1, 1] x [0, 2] that is its own image in x = 0: triangles too.
struct Sheet {
    Mesh mesh;
    std::vector<uint32_t> twin; ///< of each vertex

    Sheet() {
        const Mesh half = surfaces::plane(9, 18, 1, 2, 0.3);
        std::vector<Vec3> positions;
        for (const Vec3& p : half.positions) {
            positions.emplace_back(p.x, p.y, 0.15 * std::sin(3 * p.x + 2 * p.y) + 0.1 * p.x * p.x);
        }
        const auto count = static_cast<uint32_t>(positions.size());
        std::vector<uint32_t> other(count);
        twin.resize(count);
        for (uint32_t v = 0; v < count; ++v) {
            other[v] = v;
            if (positions[v].x != 0) {
                other[v] = static_cast<uint32_t>(positions.size());
                positions.push_back(image(positions[v]));
                twin.push_back(v);
            }
            twin[v] = other[v];
        }
        std::vector<Triangle> triangles = half.triangles;
        for (const Triangle& t : half.triangles) {
            triangles.push_back({other[t[0]], other[t[2]], other[t[1]]});
        }
        mesh = surfaces::from_triangles(std::move(positions), std::move(triangles));
    }

    uint32_t near(double x, double y) const {
        uint32_t best = 0;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            const auto away = [&](uint32_t w) {
                return std::hypot(mesh.positions[w].x - x, mesh.positions[w].y - y);
            };
            best = away(v) < away(best) ? v : best;
        }
        return best;
    }
    std::string at(double x, double y) const { return "{'vertex': " + std::to_string(near(x, y)) + "}"; }
};

ForgeResult forged_edit(const Sheet& sheet, const std::string& keys) {
    return forged_on_cpu(sheet.mesh, edit_recipe("{ " + keys + " }"));
}

/// How far the surface is from its own image, at worst.
double asymmetry(const Sheet& sheet, const ForgeResult& result) {
    double worst = 0;
    for (uint32_t v = 0; v < sheet.mesh.vertex_count(); ++v) {
        const double off = glm::distance(result.positions[sheet.twin[v]], image(result.positions[v]));
        worst = std::isfinite(off) ? std::max(worst, off) : infinity;
    }
    return worst;
}

double largest_move(const Sheet& sheet, const ForgeResult& result) {
    double largest = 0;
    for (uint32_t v = 0; v < sheet.mesh.vertex_count(); ++v) {
        largest = std::max(largest, glm::distance(result.positions[v], sheet.mesh.positions[v]));
    }
    return largest;
}

const char* const mirror = ", 'mirror': {'axis': 'x'}";

// Exact distances of both sides agree to some 1e-12 of the sheet, and a weight's slope is some 10.
constexpr double rounding = 1e-10;

} // namespace

TEST_CASE("a mirrored edit leaves a symmetric mesh symmetric, and both handles at their targets") {
    const Sheet sheet;
    const uint32_t v = sheet.near(0.45, 0.9);
    const Vec3 start = sheet.mesh.positions[v];
    for (const std::string distances : {"'method': 'exact'", "'metric': 'euclidean'"}) {
        for (const std::string target :
             {"'by': [0.2,0.1,0.3]", "'to': [0.7,1,0.5]", "'path': [[0,0,0],[0.3,0,0.1],[0.2,0.1,0.3]]"}) {
            for (const double radius : {0.3, 0.8}) { // apart, and over each other
                INFO(distances << " " << target << " " << radius);
                const ForgeResult result = forged_edit(
                    sheet, "'kind': 'translate', 'handles': [ {'at': " + sheet.at(0.45, 0.9) + ", " + target +
                               "} ], 'radius': " + text(radius) + ", " + distances + mirror);
                CHECK(asymmetry(sheet, result) <= rounding);
                const Vec3 end = target[1] == 't' ? Vec3(0.7, 1, 0.5) : start + Vec3(0.2, 0.1, 0.3);
                CHECK(glm::distance(result.positions[v], end) <= rounding);
                CHECK(glm::distance(result.positions[sheet.twin[v]], image(end)) <= rounding);
            }
        }
    }
}

TEST_CASE("where the sides do not meet each is edited as alone") {
    const Sheet sheet;
    const std::string edit = "'kind': 'translate', 'handles': [ {'at': " + sheet.at(0.6, 0.9) +
                             ", 'by': [0.1,0,0.2]} ], 'radius': 0.4, 'method': 'exact'";
    const ForgeResult alone = forged_edit(sheet, edit), both = forged_edit(sheet, edit + mirror);
    double worst = 0;
    for (uint32_t v = 0; v < sheet.mesh.vertex_count(); ++v) {
        if (sheet.mesh.positions[v].x > 0) {
            worst = std::max(worst, glm::distance(alone.positions[v], both.positions[v]));
        }
    }
    CHECK(worst <= rounding);
    CHECK(largest_move(sheet, alone) > 0.2);
}

TEST_CASE("a handle at the plane stays one and moves along it") {
    const Sheet sheet;
    const uint32_t v = sheet.near(0, 1);
    REQUIRE(sheet.mesh.positions[v].x == 0);
    const std::string start = "'kind': 'translate', 'radius': 0.6, 'method': 'exact', 'handles': [ {'at': ";
    const ForgeResult result =
        forged_edit(sheet, start + sheet.at(0, 1) + ", 'by': [0.3,0.1,0.2]} ]" + mirror);
    CHECK(result.report.edits[0].radii.size() == 1);
    CHECK(asymmetry(sheet, result) <= rounding);
    CHECK(glm::distance(result.positions[v], sheet.mesh.positions[v] + Vec3(0, 0.1, 0.2)) <= rounding);
    // A path straight away from the plane leads nowhere.
    const ForgeResult still =
        forged_edit(sheet, start + sheet.at(0, 1) + ", 'path': [[0,0,0],[0.3,0,0],[0.1,0,0]]} ]" + mirror);
    CHECK(largest_move(sheet, still) == 0);
    // How near that is can be said.
    const std::string near = start + "{'nearest': [0.04,1,0.2]}, 'by': [0,0,0.2]} ], 'mirror': {'axis': 'x'";
    CHECK(forged_edit(sheet, near + "}").report.edits[0].radii.size() == 2);
    CHECK(forged_edit(sheet, near + ", 'merge': 0.05}").report.edits[0].radii.size() == 1);
}

TEST_CASE("a handle whose image is a handle already is not repeated") {
    const Sheet sheet;
    const ForgeResult result =
        forged_edit(sheet, "'kind': 'translate', 'radius': 0.6, 'method': 'exact', 'handles': [ {'at': " +
                               sheet.at(0.45, 0.9) + ", 'by': [0,0,0.2]}, {'at': " + sheet.at(-0.45, 0.9) +
                               ", 'by': [0,0,-0.1]} ]" + mirror);
    CHECK(result.report.edits[0].radii.size() == 2);
    const uint32_t v = sheet.near(0.45, 0.9);
    CHECK(result.positions[v].z - sheet.mesh.positions[v].z == Approx(0.2));
    CHECK(result.positions[sheet.twin[v]].z - sheet.mesh.positions[sheet.twin[v]].z == Approx(-0.1));
}

TEST_CASE("rotations are mirrored about axes in the plane and upright on it; others are refused") {
    const Sheet sheet;
    const auto turn = [&](const std::string& axis, const std::string& target, double x) {
        return forged_edit(sheet, "'kind': 'rotate', 'axis': " + axis +
                                      ", 'handles': [ {'at': " + sheet.at(x, 0.9) + ", " + target +
                                      "} ], 'radius': 0.6, 'method': 'exact'" + mirror);
    };
    const std::string in_plane = "{'origin': [0,0.9,-0.3], 'direction': [0,0.2,1]}";
    const std::string upright = "{'origin': [0.7,0.5,-0.3], 'direction': [-2,0,0]}";
    for (const std::string& axis : {in_plane, upright}) {
        for (const std::string target : {"'degrees': 35", "'to': [0.3,1.2,0.4]"}) {
            INFO(axis << target);
            const ForgeResult result = turn(axis, target, 0.45);
            CHECK(asymmetry(sheet, result) <= rounding);
            CHECK(largest_move(sheet, result) > 0.02);
        }
    }
    CHECK(asymmetry(sheet, turn(upright, "'degrees': 35", 0)) <= rounding);
    CHECK(largest_move(sheet, turn(upright, "'degrees': 35", 0)) > 0.05);
    CHECK(largest_move(sheet, turn(in_plane, "'degrees': 35", 0)) == 0);
    for (const std::string axis :
         {"{'origin': [0.1,0,0], 'direction': [0,0,1]}", "{'origin': [0,0,0], 'direction': [1,0,1]}"}) {
        CHECK_THROWS_WITH(turn(axis, "'degrees': 35", 0.45),
                          Catch::Contains("edits[0].axis") && Catch::Contains("two edits"));
    }
}

TEST_CASE("anchors and pinned points are mirrored with their handle") {
    const Sheet sheet;
    const auto line = [&](double x) {
        return "{'polyline': [" + sheet.at(x, 0.5) + ", " + sheet.at(x, 1.4) + "]}";
    };
    const std::string face = "{'face': 130}";
    const auto edit = [&](const std::string& anchor, double x) {
        return "'kind': 'translate', 'radius': 0.5, 'method': 'exact', 'handles': [ {'at': " +
               sheet.at(x, 0.9) + ", 'by': [0,0.05,0.2]} ], 'anchors': [ {'handle': 0, 'at': [" + anchor +
               "]} ], 'pinned': [ " + sheet.at(x, 1.1) + " ]" + mirror;
    };
    for (const std::string& anchor : {line(0.5), face, sheet.at(0.3, 0.7), line(0.5) + ", " + face}) {
        for (const double x : {0.4, 0.0}) {
            INFO(anchor << " " << x);
            const ForgeResult result = forged_edit(sheet, edit(anchor, x));
            CHECK(asymmetry(sheet, result) <= rounding);
            CHECK(largest_move(sheet, result) > 0.1);
            const uint32_t pinned = sheet.near(x, 1.1);
            CHECK(result.positions[pinned] == sheet.mesh.positions[pinned]);
            CHECK(result.positions[sheet.twin[pinned]] == sheet.mesh.positions[sheet.twin[pinned]]);
        }
    }
}

TEST_CASE("a mirrored edit that refines puts vertices at both handles") {
    const Sheet sheet;
    const ForgeResult result = forged_edit(
        sheet, "'kind': 'translate', 'radius': 0.4, 'handles': [ {'at': {'nearest': [0.5,0.93,0.2]}, 'by': "
               "[0,0,0.3]} ], 'refine': {'tolerance': 0.05}" +
                   std::string(mirror));
    REQUIRE(result.refined);
    const auto& p = result.refined->positions;
    size_t pairs = 0;
    for (uint32_t v = 0; v < p.size(); ++v) {
        const bool moved_all = std::abs(result.positions[v].z - p[v].z - 0.3) <= 1e-9;
        for (uint32_t w = 0; moved_all && w < p.size(); ++w) {
            pairs += p[v].x > 0 && glm::distance(p[w], image(p[v])) <= 1e-9 &&
                             std::abs(result.positions[w].z - p[w].z - 0.3) <= 1e-9
                         ? 1
                         : 0;
        }
    }
    CHECK(pairs == 1);
}

TEST_CASE("a drag of a mirrored edit shows what forge makes of it") {
    const Sheet sheet;
    Recipe recipe =
        edit_recipe("{ 'kind': 'translate', 'radius': 0.6, 'handles': [ {'at': " + sheet.at(0.45, 0.9) +
                    ", 'by': [0,0,0.1]} ]" + mirror + " }");
    RefinementHistory history(sheet.mesh);
    KeptSolvers solvers;
    DragScene scene(sheet.mesh, sheet.mesh.positions, history, solvers);
    Log log;
    Progress progress;
    const auto backend = make_cpu_backend();
    const EditOccluders occluders(recipe, log, progress, nullptr);
    DragSession session(scene, occluders, *backend, recipe.edits[0], log);
    recipe.edits[0].handles[0].by = Vec3(0.1, 0.1, 0.3);
    session.update(recipe.edits[0], occluders);
    CHECK(session.work().distances == 1);
    const std::vector<Vec3> shown = session.positions();
    const ForgeResult forged = forged_on_cpu(sheet.mesh, recipe);
    double worst = 0;
    for (size_t i = 0; i < shown.size(); ++i) {
        worst = std::max(worst, glm::distance(shown[i], forged.positions[session.region().vertices[i]]));
    }
    CHECK(worst <= 1e-12);
    CHECK(largest_move(sheet, forged) > 0.3);
}
