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
        // Bones are thinner in their middle, so that the joints stand out.
        const Vec3 middle = 0.5 * (line.joints[k] + line.joints[k + 1]);
        const double waist = 0.93 * 0.5 * (line.radii[k] + line.radii[k + 1]);
        body.cone(line.joints[k], line.radii[k], middle, waist, 0.02);
        body.cone(middle, waist, line.joints[k + 1], line.radii[k + 1], 0.02);
    }
}

SmoothBody make_hand() {
    SmoothBody body;
    const auto& lines = hand_fingers();
    body.group(0);
    for (size_t k = 1; k < 5; ++k) {
        const Vec3 knuckle = lines[k].joints[0];
        body.cone({0.3 * knuckle.x, 0.09, 0}, 0.062, knuckle, 0.052, 0.06);
    }
    body.cone({0.075, 0.1, 0.03}, 0.07, {0.15, 0.26, 0.035}, 0.06, 0.06);   // ball of the thumb
    body.cone({-0.085, 0.1, 0.02}, 0.07, {-0.14, 0.3, 0.015}, 0.055, 0.06); // little finger's side
    body.cone({0.19, 0.29, 0.03}, 0.035, {0.14, 0.38, 0.005}, 0.035, 0.05); // skin between thumb and index
    body.cone({0.055, 0.1, 0}, 0.08, {0.055, -0.12, 0}, 0.078, 0.06);       // wrist
    body.cone({-0.055, 0.1, 0}, 0.08, {-0.055, -0.12, 0}, 0.078, 0.06);
    for (size_t k = 1; k < 5; ++k) {
        body.ball(lines[k].joints[0] + Vec3(0, 0, -0.018), 0.046, 0.03); // knuckles on the back
    }
    for (size_t k = 0; k < 5; ++k) {
        body.group(k == 0 ? 0.05 : 0.04);
        add_finger(body, lines[k]);
    }
    return body;
}

} // namespace

const std::array<FingerLine, 5>& hand_fingers() {
    static const std::array<FingerLine, 5> fingers{
        FingerLine{{Vec3(0.1, 0.12, 0.045), Vec3(0.235, 0.285, 0.075), Vec3(0.33, 0.4, 0.085),
                    Vec3(0.395, 0.49, 0.08)},
                   {0.065, 0.054, 0.047, 0.036}},
        finger({0.165, 0.465, 0}, 6, 0.465, {0.047, 0.042, 0.037, 0.031}),
        finger({0.055, 0.49, 0}, 0.5, 0.515, {0.048, 0.043, 0.038, 0.032}),
        finger({-0.055, 0.47, 0}, -5, 0.475, {0.046, 0.041, 0.036, 0.031}),
        finger({-0.155, 0.42, 0}, -13, 0.385, {0.041, 0.036, 0.031, 0.027}),
    };
    return fingers;
}

const SmoothBody& hand_body() {
    static const SmoothBody body = make_hand();
    return body;
}

Mesh hand(size_t vertices) {
    const SmoothBody& body = hand_body();
    const Mesh rough = polygonize([&](const Vec3& p) { return body(p); },
                                  Box{{-0.35, -0.25, -0.15}, {0.5, 1.05, 0.3}}, {110});
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
