#include "engine/mesh/polygonize.h"
#include "engine/mesh/remesh.h"
#include "engine/mesh/sample_bodies.h"

namespace anvil::sample {

namespace {

void add_head(SmoothBody& body) {
    body.group(0);
    body.ellipsoid({0, 1.3, -0.04}, {0.285, 0.32, 0.36}, 0); // cranium
    body.ellipsoid({0, 1.1, 0.07}, {0.22, 0.32, 0.25}, 0.1); // face
    body.ball({0, 0.85, 0.21}, 0.07, 0.1);                   // chin
    for (const double side : {-1.0, 1.0}) {
        body.cone({0.165 * side, 0.99, 0.0}, 0.065, {0.05 * side, 0.85, 0.19}, 0.055, 0.08);     // jaw
        body.ball({0.13 * side, 1.09, 0.2}, 0.075, 0.09);                                        // cheek
        body.cone({0.035 * side, 1.225, 0.285}, 0.035, {0.14 * side, 1.23, 0.235}, 0.035, 0.06); // brow
    }
    for (const double side : {-1.0, 1.0}) {
        body.ball({0.105 * side, 1.165, 0.365}, 0.075, 0.06).carved(); // eye socket
        body.ball({0.1 * side, 1.165, 0.235}, 0.06, 0.012);            // eye
    }
    body.cone({0, 1.21, 0.29}, 0.032, {0, 1.055, 0.38}, 0.04, 0.04); // nose
    for (const double side : {-1.0, 1.0}) {
        body.ball({0.036 * side, 1.04, 0.34}, 0.03, 0.025);
    }
    for (const double side : {-1.0, 1.0}) {
        body.cone({0, 0.962, 0.312}, 0.02, {0.06 * side, 0.95, 0.28}, 0.012, 0.025); // lips
        body.cone({0, 0.93, 0.305}, 0.022, {0.055 * side, 0.935, 0.28}, 0.012, 0.025);
    }
}

void add_ears(SmoothBody& body) {
    for (const double side : {-1.0, 1.0}) {
        body.group(0.03);
        body.ellipsoid({0.29 * side, 1.14, -0.05}, {0.04, 0.105, 0.065}, 0, -12, -8 * side);
        body.ellipsoid({0.335 * side, 1.15, -0.03}, {0.03, 0.06, 0.035}, 0.02, -12).carved();
    }
}

void add_torso(SmoothBody& body) {
    body.group(0.08);
    body.cone({0, 0.98, -0.09}, 0.165, {0, 0.5, -0.08}, 0.18, 0); // neck
    body.ellipsoid({0, 0.12, -0.02}, {0.62, 0.48, 0.3}, 0.12);    // chest
    for (const double side : {-1.0, 1.0}) {
        body.cone({0.1 * side, 0.62, -0.13}, 0.1, {0.5 * side, 0.38, -0.1}, 0.12, 0.15);   // shoulders
        body.cone({0.5 * side, 0.3, -0.06}, 0.2, {0.62 * side, -0.1, -0.04}, 0.18, 0.12);  // arms
        body.cone({0.16 * side, 1.0, -0.06}, 0.04, {0.035 * side, 0.5, 0.1}, 0.035, 0.06); // neck's muscles
        body.cone({0.06 * side, 0.5, 0.13}, 0.03, {0.42 * side, 0.48, 0.04}, 0.03, 0.06);  // collarbones
    }
}

SmoothBody make_bust() {
    SmoothBody body;
    add_head(body);
    add_ears(body);
    add_torso(body);
    body.cut_below(0, 0.04);
    return body;
}

} // namespace

const SmoothBody& bust_body() {
    static const SmoothBody body = make_bust();
    return body;
}

Mesh bust(size_t vertices) {
    const SmoothBody& body = bust_body();
    // Half the value keeps the bound that the ellipsoids' do not.
    const Mesh rough = polygonize([&](const Vec3& p) { return 0.5 * body(p); },
                                  Box{{-0.95, -0.1, -0.6}, {0.95, 1.75, 0.6}}, {110, false, true});
    return remesh_to_count(
        rough, [&](const Vec3& p) { return body.project(p); }, vertices);
}

} // namespace anvil::sample
