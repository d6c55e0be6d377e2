#include "engine/mesh/sample_bodies.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>
#include <queue>
#include <random>

using namespace anvil;

namespace {

/// Lengths of shortest paths along edges from `source`; infinite beyond `limit`.
std::vector<double> along_edges(const Mesh& mesh, uint32_t source, double limit) {
    std::vector<std::vector<uint32_t>> neighbours(mesh.vertex_count());
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            neighbours[t[i]].push_back(t[(i + 1) % 3]);
        }
    }
    std::vector<double> distance(mesh.vertex_count(), infinity);
    std::priority_queue<std::pair<double, uint32_t>> queue;
    distance[source] = 0;
    queue.emplace(0, source);
    while (!queue.empty()) {
        const auto [negative, v] = queue.top();
        queue.pop();
        for (const uint32_t w : neighbours[v]) {
            const double d = glm::distance(mesh.positions[v], mesh.positions[w]) - negative;
            if (-negative <= distance[v] && d < distance[w] && d <= limit) {
                distance[w] = d;
                queue.emplace(-d, w);
            }
        }
    }
    return distance;
}

uint32_t nearest_vertex(const Mesh& mesh, const Vec3& p) {
    uint32_t best = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (glm::distance(mesh.positions[v], p) < glm::distance(mesh.positions[best], p)) {
            best = v;
        }
    }
    return best;
}

Vec3 on_line(const sample::FingerLine& line, double t) {
    const auto bone = std::min(static_cast<size_t>(t), size_t{2});
    return glm::mix(line.joints[bone], line.joints[bone + 1], t - static_cast<double>(bone));
}

} // namespace

TEST_CASE("Hand and bust are closed, manifold, of one piece without handles, well shaped, at any count") {
    for (const std::string shape : {"hand", "bust"}) {
        for (const size_t wish : {500, 687, 2000, 5001, 27277}) {
            const Mesh mesh = make_sample(shape, wish);
            const test::MeshFacts facts = test::facts_of(mesh);
            CAPTURE(shape, wish, mesh.vertex_count());
            CHECK(std::abs(static_cast<double>(mesh.vertex_count()) / static_cast<double>(wish) - 1) <= 0.1);
            CHECK(facts.closed_manifold());
            CHECK(facts.euler == 2);
            CHECK(facts.components == 1);
            CHECK(facts.volume > 0);
            CHECK(facts.min_angle > 20);
        }
    }
}

TEST_CASE("The vertices of hand and bust lie on their implicit surfaces") {
    for (const auto& [shape, body] :
         {std::pair{"hand", &sample::hand_body()}, {"bust", &sample::bust_body()}}) {
        for (const size_t count : {700, 30000}) {
            double worst = 0;
            for (const Vec3& p : make_sample(shape, count).positions) {
                worst = std::max(worst, std::abs((*body)(p)));
            }
            CAPTURE(shape, count);
            // Newton's steps end below 1e-12 or, in a sharp valley, within its ten steps.
            CHECK(worst < 1e-9);
        }
    }
}

TEST_CASE("The gradient of a smooth body is that of its value") {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> x(-0.4, 0.5), y(-0.2, 1.6), z(-0.4, 0.4);
    for (const SmoothBody* body : {&sample::hand_body(), &sample::bust_body()}) {
        for (int i = 0; i < 500; ++i) {
            const Vec3 p(x(generator), y(generator), z(generator));
            const double step = 1e-6;
            Vec3 difference;
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 offset(0);
                offset[axis] = step;
                difference[axis] = ((*body)(p + offset) - (*body)(p - offset)) / (2 * step);
            }
            // Central differences: step^2 f''' plus eps / step, and the second derivative jumps between
            // parts.
            CHECK(glm::length(difference - body->evaluate(p).gradient) < 1e-3);
        }
    }
}

TEST_CASE("The hand stands upright: wrist at the origin, middle finger up to 1, palm to +z, thumb at +x") {
    const std::vector<Vec3> tips = hand_finger_tips();
    REQUIRE(tips.size() == 5);
    for (const Vec3& tip : tips) {
        CHECK(std::abs(sample::hand_body()(tip)) < 1e-9);
    }
    CHECK(tips[2].y == Approx(1).margin(0.02));
    for (size_t k = 0; k < 4; ++k) {
        CHECK(tips[k].x > tips[k + 1].x);
    }
    Box box;
    for (const Vec3& p : make_sample("hand", 3000).positions) {
        box.include(p);
    }
    CHECK(box.high.y == Approx(tips[2].y).margin(0.01));
    CHECK(box.low.y > -0.25);
    CHECK(sample::hand_body()(Vec3(0, 0, 0)) < -0.05);
}

TEST_CASE("The five fingers are separate: gaps of 0.03 beyond the first bone's upper part") {
    const auto& lines = sample::hand_fingers();
    for (size_t a = 0; a < 5; ++a) {
        for (size_t b = a + 1; b < 5; ++b) {
            for (double s = 0.75; s <= 3; s += 0.05) {
                for (double t = 0.75; t <= 3; t += 0.05) {
                    const Vec3 p = on_line(lines[a], s), q = on_line(lines[b], t);
                    const auto radius = [](const sample::FingerLine& line, double u) {
                        const auto bone = std::min(static_cast<size_t>(u), size_t{2});
                        return std::max(line.radii[bone], line.radii[bone + 1]);
                    };
                    CAPTURE(a, b, s, t);
                    REQUIRE(glm::distance(p, q) - radius(lines[a], s) - radius(lines[b], t) > 0.03);
                }
            }
        }
    }
}

TEST_CASE("Around the index tip the middle finger is near in space and far along the surface") {
    const Mesh mesh = make_sample("hand", 8000);
    const std::vector<Vec3> tips = hand_finger_tips();
    const uint32_t tip = nearest_vertex(mesh, tips[1]);
    const std::vector<double> path = along_edges(mesh, tip, 0.45);
    size_t near = 0;
    const auto& lines = sample::hand_fingers();
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (size_t other : {0, 2, 3, 4}) {
            for (double t = 1.2; t <= 3; t += 0.1) {
                if (glm::distance(mesh.positions[v], on_line(lines[other], t)) < 0.06) {
                    near += other == 2 && glm::distance(mesh.positions[v], mesh.positions[tip]) < 0.2;
                    // Along edges is longer than straight along the surface by 15 % at most on such
                    // triangles.
                    REQUIRE(path[v] == infinity);
                }
            }
        }
    }
    CHECK(near > 20);
    // The finger itself is reached down to its knuckle.
    CHECK(path[nearest_vertex(mesh, lines[1].joints[1] + Vec3(0, 0, lines[1].radii[1]))] < 0.3);
}

TEST_CASE("Hand and bust are the same every time, whatever the threads do") {
    for (const char* shape : {"hand", "bust"}) {
        const Mesh a = make_sample(shape, 3000), b = make_sample(shape, 3000);
        CHECK(a.positions == b.positions);
        CHECK(a.triangles == b.triangles);
    }
}
