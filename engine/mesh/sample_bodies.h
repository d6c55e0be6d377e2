// The samples made of blended round cones: a hand and a bust.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/mesh/smooth_body.h"

#include <array>

namespace anvil::sample {

/// The joints of a finger of the sample hand, from the knuckle to the centre of the tip, with the radii
/// there; the surface runs within 15 % of the radius around this centre line where the finger is free.
struct FingerLine {
    std::array<Vec3, 4> joints;
    std::array<double, 4> radii;
};

/// Thumb, index, middle, ring, little.
const std::array<FingerLine, 5>& hand_fingers();

const SmoothBody& hand_body();
const SmoothBody& bust_body();

Mesh hand(size_t vertices);
Mesh bust(size_t vertices);

} // namespace anvil::sample
