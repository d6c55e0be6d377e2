// The samples that have a closed form; make_sample is their face and checks their least counts.
#pragma once

#include "engine/mesh/mesh.h"

namespace anvil::sample {

inline constexpr double cylinder_radius = 0.5;
inline constexpr double cylinder_half_height = 1;
inline constexpr double torus_radius = 1;
inline constexpr double torus_tube = 0.4;

Mesh sphere(size_t vertices);
Mesh plane(size_t vertices);
Mesh cylinder(size_t vertices);
Mesh torus(size_t vertices);
Mesh cube(size_t vertices);

/// Icosahedron whose faces are cut into frequency^2 triangles, pushed out to the unit sphere:
/// 10 frequency^2 + 2 vertices. frequency >= 1.
Mesh geodesic_sphere(size_t frequency);

} // namespace anvil::sample
