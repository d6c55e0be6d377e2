#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/winding_number.h"
#include "tests/support/contact_scene.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace anvil;
using test::random_in;

namespace {

void flip(Mesh& mesh, double share, uint32_t seed) {
    std::mt19937 random(seed);
    for (Triangle& t : mesh.triangles) {
        if (random() < share * 4294967296.0) {
            std::swap(t[1], t[2]);
        }
    }
}

/// Share of random points, farther than `near` from the unit sphere, whose sign is not the sphere's.
double wrong_signs(const Mesh& mesh, double near) {
    const auto solid = mesh_distance(mesh);
    std::mt19937 random(5);
    int wrong = 0;
    int counted = 0;
    while (counted < 4000) {
        const Vec3 p = random_in(random, Vec3(-1.3), Vec3(1.3));
        const double truth = glm::length(p) - 1;
        if (std::abs(truth) > near) {
            ++counted;
            wrong += (solid->at(p).distance < 0) != (truth < 0) ? 1 : 0;
        }
    }
    return wrong / 4000.0;
}

} // namespace

TEST_CASE("the winding number is the sum of all solid angles, one inside and none outside") {
    const Mesh mesh = make_sample("torus", 3000);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    std::mt19937 random(3);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, Vec3(-1.5), Vec3(1.5));
        const double tube = std::hypot(std::hypot(p.x, p.z) - 1, p.y) - 0.4;
        if (std::abs(tube) > 0.01) { // the mesh's own coarseness
            CHECK(winding.at(p) == Approx(tube < 0 ? 1 : 0).margin(0.01));
        }
    }
}

TEST_CASE("the winding number is the same to the bit whoever asks first, and of nothing it is none") {
    const Mesh mesh = make_sample("bust", 3000);
    const WindingNumber one_by_one(mesh.positions, mesh.triangles);
    const WindingNumber at_once(mesh.positions, mesh.triangles);
    std::mt19937 random(4);
    std::vector<Vec3> points(4000);
    for (Vec3& p : points) {
        p = random_in(random, Vec3(-1), Vec3(1));
    }
    std::vector<double> found(points.size());
    parallel_for(points.size(), 10, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            found[i] = at_once.at(points[i]);
        }
    });
    for (size_t i = points.size(); i-- > 0;) {
        CHECK(found[i] == one_by_one.at(points[i]));
    }
    CHECK(WindingNumber({}, {}).at(Vec3(0)) == 0);
    CHECK(WindingNumber({}, {}).at(Vec3(1)) == 0);
}

TEST_CASE("the distance to a fine sphere mesh is that to the sphere, with its normal") {
    const auto solid = mesh_distance(make_sample("icosphere", 10242));
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = random_in(random, Vec3(-1.5), Vec3(1.5));
        const SignedDistance s = solid->at(p);
        // Sagitta of an edge of 0.04: 0.04^2 / 8, and as much again across the face.
        CHECK(std::abs(s.distance - (glm::length(p) - 1)) < 4e-4);
        if (std::abs(s.distance) > 0.05) {
            CHECK(glm::dot(s.normal, p) > 0.99 * glm::length(p));
        }
    }
}

TEST_CASE("open, inverted, doubled, overlapping and partly flipped meshes keep their inside") {
    const Mesh whole = make_sample("icosphere", 2562);
    CHECK(wrong_signs(whole, 0.01) == 0);

    Mesh inverted = whole;
    flip(inverted, 1, 1);
    CHECK(wrong_signs(inverted, 0.01) == 0);

    Mesh open = whole; // a hole of about 2 % of the area
    std::erase_if(open.triangles, [&](const Triangle& t) { return whole.positions[t[0]].y > 0.96; });
    CHECK(wrong_signs(open, 0.05) < 2e-3);

    Mesh doubled = whole;
    doubled.triangles.insert(doubled.triangles.end(), whole.triangles.begin(), whole.triangles.end());
    CHECK(wrong_signs(doubled, 0.01) == 0);

    Mesh overlapping = whole; // a second, smaller ball inside: the winding number is 2 there
    const auto count = static_cast<uint32_t>(whole.vertex_count());
    for (const Vec3& p : whole.positions) {
        overlapping.positions.push_back(0.3 * p + Vec3(0.6, 0, 0));
    }
    for (const Triangle& t : whole.triangles) {
        overlapping.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    }
    const auto solid = mesh_distance(overlapping);
    CHECK(solid->at(Vec3(0.6, 0, 0)).distance < 0);
    CHECK(solid->at(Vec3(-0.9, 0, 0)).distance < 0);
    CHECK(solid->at(Vec3(1.2, 0, 0)).distance > 0);

    Mesh flipped = whole;
    flip(flipped, 0.05, 2);
    CHECK(wrong_signs(flipped, 0.02) <= 0.002);
}

TEST_CASE("a mesh without triangles is no occluder") {
    CHECK_THROWS_AS(mesh_distance(Mesh{}), InputError);
}

TEST_CASE("nothing that started outside ends inside a mesh, closed or open, alone or in a Boolean shape") {
    const ScratchFolder folder;
    Mesh tool = make_sample("torus", 3000);
    write_mesh(folder / "torus.ply", tool, tool.positions);
    std::erase_if(tool.triangles, [&](const Triangle& t) { return tool.positions[t[0]].x > 1.37; });
    Mesh open;
    open.positions = tool.positions;
    for (const Triangle& t : tool.triangles) {
        open.add_polygon(t);
    }
    triangulate(open);
    write_mesh(folder / "open.ply", open, open.positions);
    const CsgShape half{CsgOperation::subtract,
                        {{"", {MeshShape{"torus.ply"}}, {}}, {"", {BoxShape{Vec3(2), 0}}, {{0, 2, 0}}}}};
    for (const OccluderShape& shape :
         {OccluderShape{MeshShape{"torus.ply"}}, OccluderShape{MeshShape{"open.ply"}}, OccluderShape{half}}) {
        Log log;
        Progress progress;
        const OccluderModel model =
            build_model(shape, {FieldKind::dense, 64}, progress, {folder.path(), &log});
        OccluderSet set;
        add_occluder(set, model, "tool", {}, {InfluenceKind::hard, 0.9, {}, {}, 0}, {Vec3(0), 3, 1});
        test::Scene scene;
        std::mt19937 random(6);
        while (scene.points.size() < 300) {
            const Vec3 p = random_in(random, Vec3(-1.6), Vec3(1.6));
            if (exact_distance(set, p).distance > 0) {
                scene.points.push_back(p);
                scene.displacements.push_back(-2.0 * p + random_in(random, Vec3(-0.5), Vec3(0.5)));
            }
        }
        const test::SceneResult result = test::run_scene(scene, set, *make_cpu_backend(), true);
        for (const Vec3& end : result.ends) {
            CHECK(exact_distance(set, end).distance >= -1e-6 * set.sizes[0]);
        }
    }
}
