#include "engine/mesh/polygonize.h"
#include "engine/mesh/remesh.h"
#include "engine/mesh/sample_bodies.h"
#include "engine/mesh/sample_shapes.h"

#include <numbers>

namespace anvil::sample {

namespace {

/// A finger from its knuckle: leaning by `lean` degrees towards +x, its bones bent towards the palm (+z).
FingerLine finger(const Vec3& knuckle, double lean, double length, const std::array<double, 4>& radii) {
    constexpr std::array<double, 3> bone{0.49, 0.29, 0.22}; // shares of the length, tip's radius included
    constexpr std::array<double, 3> bend{3, 8, 13};         // degrees from the palm's plane
    const double degree = std::numbers::pi / 180;
    FingerLine line{{knuckle}, radii};
    for (size_t k = 0; k < 3; ++k) {
        const double reach = bone[k] * length - (k == 2 ? radii[3] : 0);
        const double up = std::cos(bend[k] * degree);
        line.joints[k + 1] =
            line.joints[k] + reach * Vec3(up * std::sin(lean * degree), up * std::cos(lean * degree),
                                          std::sin(bend[k] * degree));
    }
    return line;
}

void add_finger(SmoothBody& body, const FingerLine& line) {
    for (size_t k = 0; k < 3; ++k) {
        // Where two bones meet, the blend swells the finger a little: its joints.
        body.cone(line.joints[k], line.radii[k], line.joints[k + 1], line.radii[k + 1], 0.016);
    }
}

void add_palm(SmoothBody& body) {
    body.group(0);
    for (size_t k = 1; k < 5; ++k) {
        const Vec3 knuckle = hand_fingers()[k].joints[0];
        body.cone({0.35 * knuckle.x, 0.1, 0}, 0.06, knuckle, 0.05, 0.1);
    }
    body.ellipsoid({0.005, 0.3, -0.005}, {0.19, 0.25, 0.062}, 0.08);
    body.cone({0.08, 0.11, 0.025}, 0.065, {0.155, 0.25, 0.04}, 0.06, 0.09);   // ball of the thumb
    body.cone({-0.08, 0.12, 0.02}, 0.065, {-0.12, 0.28, 0.018}, 0.055, 0.09); // little finger's side
    body.cone({0.2, 0.29, 0.035}, 0.035, {0.15, 0.37, 0.01}, 0.035, 0.06);    // skin between thumb and index
    for (const double x : {-0.055, 0.0, 0.055}) {
        body.cone({x, 0.09, 0}, 0.074, {x, -0.12, 0}, 0.074, 0.08); // wrist
    }
    for (size_t k = 1; k < 5; ++k) {
        body.ball(hand_fingers()[k].joints[0] + Vec3(0, -0.005, -0.014), 0.042, 0.04); // knuckles on the back
    }
}

SmoothBody make_hand() {
    SmoothBody body;
    add_palm(body);
    for (size_t k = 0; k < 5; ++k) {
        body.group(k == 0 ? 0.06 : 0.045);
        add_finger(body, hand_fingers()[k]);
    }
    return body;
}

} // namespace

const std::array<FingerLine, 5>& hand_fingers() {
    static const std::array<FingerLine, 5> fingers{
        FingerLine{{Vec3(0.1, 0.12, 0.045), Vec3(0.235, 0.285, 0.075), Vec3(0.32, 0.395, 0.085),
                    Vec3(0.38, 0.485, 0.08)},
                   {0.07, 0.058, 0.05, 0.041}},
        finger({0.165, 0.465, 0}, 8.5, 0.465, {0.052, 0.0475, 0.043, 0.038}),
        finger({0.053, 0.485, 0}, 1, 0.515, {0.053, 0.0485, 0.044, 0.039}),
        finger({-0.056, 0.465, 0}, -6.5, 0.48, {0.051, 0.0465, 0.042, 0.0375}),
        finger({-0.156, 0.415, 0}, -16, 0.395, {0.046, 0.041, 0.037, 0.033}),
    };
    return fingers;
}

const SmoothBody& hand_body() {
    static const SmoothBody body = make_hand();
    return body;
}

Mesh hand(size_t vertices) {
    const SmoothBody& body = hand_body();
    // Half the value keeps the bound that the ellipsoids' do not.
    const Mesh rough = polygonize([&](const Vec3& p) { return 0.5 * body(p); },
                                  Box{{-0.35, -0.25, -0.15}, {0.5, 1.05, 0.3}}, {110, false, true});
    return remesh_to_count(
        rough, [&](const Vec3& p) { return body.project(p); }, vertices);
}

} // namespace anvil::sample

namespace anvil {

std::vector<Vec3> hand_finger_tips() {
    std::vector<Vec3> tips;
    for (const sample::FingerLine& line : sample::hand_fingers()) {
        const Vec3 direction = glm::normalize(line.joints[3] - line.joints[2]);
        tips.push_back(sample::hand_body().project(line.joints[3] + line.radii[3] * direction));
    }
    return tips;
}

} // namespace anvil
