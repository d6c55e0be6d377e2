#include "engine/core/error.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Vec3 random_unit(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    const double z = normal(random);
    return glm::normalize(Vec3(x, y, z));
}

/// A handle somewhere: at a vertex, or inside a triangle of the mesh.
std::string random_address(const Mesh& mesh, std::mt19937& random, bool inside) {
    if (!inside) {
        return "{'vertex': " + std::to_string(random() % mesh.vertex_count()) + "}";
    }
    return "{'face': " + std::to_string(random() % mesh.polygon_count()) +
           ", 'barycentric': [0.25,0.25,0.5]}";
}

/// Where the recipe's handle stands on these positions.
Vec3 place_of(const Mesh& mesh, std::span<const Vec3> positions, const SurfaceAddress& address) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        return positions[vertex->vertex];
    }
    const auto& face = std::get<FaceAddress>(address);
    Vec3 p(0);
    const Triangle& t = mesh.triangles[mesh.first_triangle(face.face) + face.triangle];
    for (int i = 0; i < 3; ++i) {
        p += face.barycentric[i] * positions[t[i]];
    }
    return p;
}

std::string handles_text(const Mesh& mesh, std::mt19937& random, int k, const char* kind, bool inside) {
    std::string handles;
    for (int i = 0; i < k; ++i) {
        std::uniform_real_distribution<double> degrees(-40, 40);
        const std::string target = std::string(kind) == "translate"
                                       ? "'by': " + text(0.2 * random_unit(random))
                                       : "'degrees': " + text(degrees(random));
        handles += (i > 0 ? ", " : "") + std::string("{'at': ") + random_address(mesh, random, inside) +
                   ", " + target + "}";
    }
    return handles;
}

} // namespace

TEST_CASE("handles land on their targets: one, four, sixteen, overlapping, moved and turned, inside faces") {
    const Mesh mesh = make_sample("sphere", 3000);
    std::mt19937 random(1);
    int well_conditioned = 0;
    for (int round = 0; round < 24; ++round) {
        const int k = round % 3 == 0 ? 1 : round % 3 == 1 ? 4 : 16;
        const char* kind = round % 2 == 0 ? "translate" : "rotate";
        const Recipe recipe =
            edit_recipe("{ 'kind': '" + std::string(kind) + "', 'radius': 0.9, " +
                        (round % 2 == 0 ? "" : "'axis': {'origin': [0.3,0,0], 'direction': [1,2,2]}, ") +
                        "'handles': [" + handles_text(mesh, random, k, kind, round % 4 > 1) + "] }");
        const ForgeResult result = forged_on_cpu(mesh, recipe);
        const EditReport& report = result.report.edits[0];
        const Edit& edit = recipe.edits[0];
        for (int i = 0; i < k; ++i) {
            const Vec3 start = place_of(mesh, mesh.positions, edit.handles[i].at);
            const Vec3 end = place_of(mesh, result.positions, edit.handles[i].at);
            INFO(kind << ", k = " << k << ", amplification " << report.amplification);
            if (edit.kind == EditKind::translate) {
                // sum_j |alpha_j X_j| <= amplification * max |D|; three roundings of the position itself on
                // top.
                const double bound = 8 * epsilon * report.amplification * 0.2 + 4 * epsilon;
                CHECK(glm::length(end - start - *edit.handles[i].by) <= bound);
            }
            // A turned point inside a face has one angle to choose: what remains is the face's chord.
            const bool chord = edit.kind == EditKind::rotate && round % 4 > 1;
            if (report.amplification <= 10) {
                ++well_conditioned;
                CHECK(report.target_errors[i] <= (chord ? 1e-4 : 1e-12 * 3.5));
            }
        }
    }
    CHECK(well_conditioned > 50);
}

TEST_CASE("a turned handle inside a big face stands at the asked angle") {
    const Mesh mesh = make_sample("icosphere", 42);
    const Recipe recipe = edit_recipe(
        "{ 'kind': 'rotate', 'radius': 2, 'axis': {'origin': [0,0,0], 'direction': [0,0,1]}, 'handles': "
        "[ {'at': {'face': 7, 'barycentric': [0.3,0.3,0.4]}, 'degrees': 35} ] }");
    const ForgeResult result = forged_on_cpu(mesh, recipe);
    const Vec3 start = place_of(mesh, mesh.positions, recipe.edits[0].handles[0].at);
    const Vec3 end = place_of(mesh, result.positions, recipe.edits[0].handles[0].at);
    const double angle = std::atan2(start.x * end.y - start.y * end.x, start.x * end.x + start.y * end.y);
    CHECK(glm::degrees(angle) == Approx(35).epsilon(1e-12));
}

TEST_CASE("what lies outside the region of influence is bit for bit as before") {
    const Mesh mesh = make_sample("sphere", 5000);
    const Recipe recipe = edit_recipe("{ 'kind': 'translate', 'radius': 0.5, 'handles': [ {'at': {'nearest': "
                                      "[0,1,0]}, 'by': [0.1,0.3,0]} ] }");
    const ForgeResult result = forged_on_cpu(mesh, recipe);
    size_t moved = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const double distance = std::acos(std::clamp(mesh.positions[v].y, -1.0, 1.0)); // along the sphere
        if (distance > 0.51) {
            CHECK(result.positions[v] == mesh.positions[v]);
        }
        moved += result.moved[v] ? 1 : 0;
        CHECK(result.moved[v] == (result.positions[v] != mesh.positions[v]));
    }
    CHECK(moved == result.report.edits[0].moved);
    CHECK(moved > 100);
}

TEST_CASE("a finger moves alone by geodesic distance and with its neighbours by Euclidean distance") {
    const Mesh mesh = make_sample("hand", 6000);
    const auto tips = hand_finger_tips();
    const std::string edit =
        "{ 'kind': 'translate', 'radius': 0.25, 'handles': [ {'at': {'nearest': " + text(tips[1]) +
        "}, 'by': [0,0,0.1]} ], 'metric': ";
    const ForgeResult geodesic = forged_on_cpu(mesh, edit_recipe(edit + "'geodesic' }"));
    const ForgeResult euclidean = forged_on_cpu(mesh, edit_recipe(edit + "'euclidean' }"));
    size_t moved_by_euclidean = 0;
    for (size_t finger : {0U, 2U, 3U, 4U}) {
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            // Nearer to another finger's tip than the fingers are long, and farther from the index finger's
            // tip.
            const double own = glm::length(mesh.positions[v] - tips[finger]);
            if (own < 0.15 && own < glm::length(mesh.positions[v] - tips[1])) {
                CHECK(geodesic.positions[v] == mesh.positions[v]);
                moved_by_euclidean += euclidean.moved[v] ? 1 : 0;
            }
        }
    }
    CHECK(geodesic.report.edits[0].moved > 100);
    CHECK(moved_by_euclidean > 20);
}

TEST_CASE("edits apply in order, each on what the one before left") {
    const Mesh mesh = make_sample("sphere", 2000);
    const std::string first =
        "{ 'kind': 'translate', 'radius': 0.8, 'handles': [ {'at': {'vertex': 5}, 'by': [0,0.4,0]} ] }";
    const std::string second =
        "{ 'kind': 'rotate', 'radius': 0.6, 'axis': {'origin': [0,0,0], 'direction': [0,0,1]}, "
        "'handles': [ {'at': {'vertex': 90}, 'degrees': 20} ] }";
    const ForgeResult both = forged_on_cpu(mesh, edit_recipe(first + ", " + second));
    Mesh between = mesh;
    between.positions = forged_on_cpu(mesh, edit_recipe(first)).positions;
    ForgeResult apart = forged_on_cpu(between, edit_recipe(second));
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        // The local origin differs with the mesh's box: displacements agree to rounding.
        CHECK(glm::length(both.positions[v] - apart.positions[v]) < 1e-14);
    }
}

TEST_CASE("the amount scales an edit, pinned points stay, and several anchors take the least distance") {
    const Mesh mesh = make_sample("plane", 2500);
    const auto edit = [](const std::string& extra, const std::string& handle = "[0,0,0]") {
        return edit_recipe("{ 'kind': 'translate', 'radius': 0.3, " + extra +
                           "'handles': [ {'at': {'nearest': " + handle + "}, 'by': [0,0,0.2]} ] }");
    };
    const ForgeResult whole = forged_on_cpu(mesh, edit(""));
    const ForgeResult half = forged_on_cpu(mesh, edit("'amount': 0.5, "));
    const uint32_t pin = nearest_vertex(mesh, {0.1, 0.1, 0});
    const ForgeResult pinned =
        forged_on_cpu(mesh, edit("'pinned': [ {'vertex': " + std::to_string(pin) + "} ], "));
    const ForgeResult anchored = forged_on_cpu(
        mesh,
        edit("'anchors': [ {'handle': 0, 'at': [ {'nearest': [-0.2,0,0]}, {'nearest': [0.2,0,0]} ]} ], ",
             "[0.1,0.1,0]"));
    CHECK(pinned.positions[pin] == mesh.positions[pin]);
    CHECK(whole.positions[pin] != mesh.positions[pin]);
    const double at_handle =
        std::pow(std::sqrt(0.02) / 0.3, 2) * (3 - 2 * std::sqrt(0.02) / 0.3); // 1 - phi, smooth
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.positions[v];
        CHECK(half.positions[v].z == Approx(0.5 * whole.positions[v].z).margin(1e-15));
        if (v != pin) {
            CHECK(pinned.positions[v].z == Approx(whole.positions[v].z).margin(1e-15));
        }
        // A flat mesh: distances are straight, and the anchors lie at vertices or inside faces alike.
        const double t = std::min(glm::length(p - Vec3(-0.2, 0, 0)), glm::length(p - Vec3(0.2, 0, 0))) / 0.3;
        const double phi = t < 1 ? 1 - t * t * (3 - 2 * t) : 0;
        CHECK(anchored.positions[v].z == Approx(0.2 * phi / (1 - at_handle)).margin(4e-3));
    }
}

TEST_CASE("without a radius, influence ends half way to the farthest point") {
    const Mesh mesh = make_sample("plane", 900);
    const ForgeResult result = forged_on_cpu(
        mesh, edit_recipe("{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 0}, 'by': [0,0,0.1]} ] }"));
    double farthest = 0;
    for (const Vec3& p : mesh.positions) {
        farthest = std::max(farthest, glm::length(p - mesh.positions[0]));
    }
    CHECK(result.report.edits[0].radii[0] == Approx(0.5 * farthest).epsilon(1e-3));
}

TEST_CASE("arc and chord end at the same place, and angles are not wrapped") {
    const Mesh mesh = make_sample("cylinder", 2000);
    const auto turn = [](const std::string& degrees, const std::string& sweep) {
        return edit_recipe("{ 'kind': 'rotate', 'sweep': '" + sweep +
                           "', 'radius': 2, 'shape': 'linear', 'axis': {'origin': [0,0,0], 'direction': "
                           "[0,1,0]}, 'handles': "
                           "[ {'at': {'nearest': [0,1,0]}, 'degrees': " +
                           degrees + "} ] }");
    };
    const ForgeResult arc = forged_on_cpu(mesh, turn("720", "arc"));
    const ForgeResult chord = forged_on_cpu(mesh, turn("720", "chord"));
    const ForgeResult none = forged_on_cpu(mesh, turn("0", "arc"));
    double twist = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(glm::length(arc.positions[v] - chord.positions[v]) < 1e-14);
        CHECK(none.positions[v] == mesh.positions[v]);
        twist = std::max(twist, glm::length(arc.positions[v] - mesh.positions[v]));
        CHECK(std::hypot(arc.positions[v].x, arc.positions[v].z) ==
              Approx(std::hypot(mesh.positions[v].x, mesh.positions[v].z)).margin(1e-14));
    }
    CHECK(twist > 0.99); // a diameter: half a turn somewhere along the double twist
}

TEST_CASE("a scene scaled by a power of two, moved far away or turned gives the same result") {
    const Mesh mesh = make_sample("sphere", 1500);
    const auto recipe = [](const Vec3& move, double scale, bool turned) {
        const auto place = [&](Vec3 p) {
            p = turned ? Vec3(-p.y, p.x, p.z) : p; // a quarter turn is exact
            return text(scale * p + move);
        };
        const Vec3 by = turned ? Vec3(0.6, 0, 0) : Vec3(0, -0.6, 0);
        return recipe_of(
            "{ 'anvil': 1, 'mesh': 'm', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': " +
            text(0.4 * scale) + "}}, 'transform': {'translate': " + place({0.1, 0.2, 0}) +
            "}, 'influence': {'kind': 'soft', 'sigma': " + text(0.05 * scale) +
            "}} ], 'edits': [ {'kind': 'translate', 'radius': " + text(0.8 * scale) +
            ", 'handles': [ {'at': {'vertex': 3}, 'by': " + text(scale * by) + "} ] } ] }");
    };
    Mesh base = mesh; // vertex 3 to the top
    const Vec3 axis = glm::cross(base.positions[3], Vec3(0, 1, 0));
    const double angle = std::acos(base.positions[3].y);
    for (Vec3& p : base.positions) {
        const Vec3 n = glm::normalize(axis);
        p = std::cos(angle) * p + std::sin(angle) * glm::cross(n, p) +
            (1 - std::cos(angle)) * glm::dot(n, p) * n;
    }
    const ForgeResult truth = forged_on_cpu(base, recipe(Vec3(0), 1, false));
    CHECK(truth.report.edits[0].contact->contact_vertices > 0);
    for (double scale : {0x1p-20, 0x1p20}) {
        Mesh scaled = base;
        for (Vec3& p : scaled.positions) {
            p *= scale;
        }
        const ForgeResult result = forged_on_cpu(scaled, recipe(Vec3(0), scale, false));
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            CHECK(glm::length(result.positions[v] / scale - truth.positions[v]) < 1e-12);
        }
    }
    const Vec3 far(1e5, -1e5, 3e4);
    Mesh moved = base;
    Mesh turned = base;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        moved.positions[v] += far;
        turned.positions[v] = Vec3(-base.positions[v].y, base.positions[v].x, base.positions[v].z);
    }
    const ForgeResult far_away = forged_on_cpu(moved, recipe(far, 1, false));
    const ForgeResult sideways = forged_on_cpu(turned, recipe(Vec3(0), 1, true));
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 t = truth.positions[v];
        // Positions at 1e5 are rounded to 1.5e-11; contact on the ball amplifies that a little.
        CHECK(glm::length(far_away.positions[v] - far - t) < 1e-8);
        CHECK(glm::length(sideways.positions[v] - Vec3(-t.y, t.x, t.z)) < 1e-8);
    }
}

TEST_CASE("a hand that rests on the ball stays where it does not move and never enters") {
    const Mesh mesh = make_sample("hand", 4000);
    const Vec3 tip = hand_finger_tips()[2];
    // A ball in front of the middle finger's pad, just large enough to touch it.
    const Vec3 centre = tip + Vec3(0, -0.05, 0.15);
    const double radius = glm::length(mesh.positions[nearest_vertex(mesh, centre)] - centre);
    const std::string ball = "{'name': 'ball', 'shape': {'sphere': {'radius': " + text(radius) +
                             "}}, 'transform': {'translate': " + text(centre) +
                             "}, 'influence': {'kind': 'hard'}}";
    const auto recipe = [&](const std::string& by) {
        return recipe_of("{ 'anvil': 1, 'mesh': 'm', 'occluders': [ " + ball +
                         " ], 'edits': [ {'kind': 'translate', "
                         "'radius': 0.4, 'handles': [ {'at': {'vertex': " +
                         std::to_string(nearest_vertex(mesh, tip)) + "}, 'by': " + by + "} ] } ] }");
    };
    const ForgeResult still = forged_on_cpu(mesh, recipe("[0,0,0]"));
    CHECK(still.positions == mesh.positions);
    for (double size : {1e-9, 1e-4, 0.05, 0.3}) {
        const ForgeResult result = forged_on_cpu(mesh, recipe(text(Vec3(0, 0, size))));
        const ContactReport& contact = *result.report.edits[0].contact;
        CHECK(contact.started_inside == 0);
        CHECK(contact.penetrating_vertices == 0);
        CHECK(contact.max_penetration <= 1e-6 * 0.2);
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            REQUIRE(glm::length(result.positions[v] - mesh.positions[v]) <=
                    size * (1 + 1e-9) + 1e-14); // positions are rounded
        }
    }
}

TEST_CASE("entries of an edit override pose and influence for that edit alone") {
    const Mesh mesh = make_sample("plane", 1600);
    const std::string edit =
        "{'kind': 'translate', 'radius': 0.4, 'handles': [ {'at': {'nearest': [0,0,0]}, 'by': [0,0,-0.5]} ]";
    const auto lowest = [&](const std::string& occluders) {
        const ForgeResult result = forged_on_cpu(
            mesh,
            recipe_of(
                "{ 'anvil': 1, 'mesh': 'm', 'occluders': [ {'name': 'floor', 'shape': {'plane': {'normal': "
                "[0,0,1], 'offset': -0.1}}, 'influence': {'kind': 'hard'}} ], 'edits': [ " +
                edit + occluders + "} ] }"));
        double z = 0;
        for (const Vec3& p : result.positions) {
            z = std::min(z, p.z);
        }
        return z;
    };
    CHECK(lowest("") == Approx(-0.1).epsilon(1e-9));
    CHECK(lowest(", 'occluders': []") == Approx(-0.5).epsilon(1e-3));
    CHECK(lowest(", 'occluders': ['floor']") == Approx(-0.1).epsilon(1e-9));
    CHECK(lowest(", 'occluders': [ {'name': 'floor', 'transform': {'translate': [0,0,-0.2]}} ]") ==
          Approx(-0.3).epsilon(1e-9));
}

TEST_CASE("what cannot be done is refused with the place and what would mend it") {
    const Mesh mesh = make_sample("sphere", 500);
    const auto message = [&](const std::string& edit) -> std::string {
        try {
            forged_on_cpu(mesh, edit_recipe(edit));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message(
              "{'kind': 'translate', 'radius': 1, 'handles': [ {'at': {'vertex': 123456}, 'by': [1,0,0]} ] }")
              .find("edits[0].handles[0].at: vertex 123456 is out of range") != std::string::npos);
    CHECK(
        message(
            "{'kind': 'translate', 'radius': 1, 'handles': [ {'at': {'face': 99999, 'barycentric': [1,0,0]}, "
            "'by': [1,0,0]} ] }")
            .find("face 99999") != std::string::npos);
    // Two targets for one place.
    CHECK(message(
              "{'kind': 'translate', 'radius': 1, 'handles': [ {'at': {'vertex': 3}, 'by': [1,0,0]}, {'at': "
              "{'vertex': 3}, 'by': [0,1,0]} ] }")
              .find("handles[") != std::string::npos);
    // A handle that no weight reaches: its anchor is far away, or it is pinned.
    CHECK(!message("{'kind': 'translate', 'radius': 0.1, 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': "
                   "[1,0,0]} ], "
                   "'anchors': [ {'handle': 0, 'at': [ {'nearest': [0,-1,0]} ]} ] }")
               .empty());
    CHECK(!message("{'kind': 'translate', 'radius': 0.5, 'handles': [ {'at': {'vertex': 3}, 'by': [1,0,0]} "
                   "], 'pinned': "
                   "[ {'vertex': 3} ] }")
               .empty());
}

TEST_CASE("least squares brings two handles at one place to the middle of their targets") {
    const Mesh mesh = make_sample("sphere", 500);
    const ForgeResult result = forged_on_cpu(
        mesh,
        edit_recipe(
            "{'kind': 'translate', 'radius': 1, 'least_squares': true, 'handles': [ {'at': {'vertex': 3}, "
            "'by': [1,0,0]}, {'at': {'vertex': 3}, 'by': [0,1,0]} ] }"));
    CHECK(result.report.edits[0].rank == 1);
    CHECK(glm::length(result.positions[3] - mesh.positions[3] - Vec3(0.5, 0.5, 0)) < 1e-14);
}

TEST_CASE("volumes are given for closed meshes and absent for open ones") {
    const auto volume = [](const std::string& shape) {
        const Mesh mesh = make_sample(shape, 2000);
        return forged_on_cpu(
                   mesh,
                   edit_recipe("{'kind': 'translate', 'radius': 0.3, 'handles': [ {'at': {'vertex': 0}, "
                               "'by': [0,0,0]} ] }"))
            .report.edits[0]
            .volume;
    };
    CHECK(!volume("plane"));
    REQUIRE(volume("sphere"));
    CHECK(volume("sphere")->before == Approx(4.18879).epsilon(0.01));
    CHECK(volume("sphere")->after == volume("sphere")->before);
}
