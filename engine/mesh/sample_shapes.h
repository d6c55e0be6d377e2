// Meshes made on the spot, at any resolution: `anvil sample`, examples, tests and benchmarks use them.
#pragma once

#include "engine/mesh/mesh.h"

#include <string>
#include <vector>

namespace anvil {

inline constexpr size_t max_sample_vertices = 50'000'000;

/// Names that make_sample knows, sorted.
const std::vector<std::string>& sample_shape_names();

/// The shape with a number of vertices within 10 % of `vertices`; y up; the same call gives the same mesh bit
/// for bit. All but the plane are closed; all are manifold and oriented outwards.
///   sphere, icosphere  radius 1 at the origin; a subdivided icosahedron (10 f^2 + 2 vertices) wherever that
///   is
///                      within 10 %, else rings; from 4 vertices
///   plane              unit square z = 0, centred at the origin, normals +z, open; from 4
///   cylinder           radius 0.5, y from -1 to 1, with caps; from 8
///   torus              radii 1 and 0.4 around the y axis; from 9
///   cube               side 1, centred at the origin; from 8
///   hand               a right hand, wrist at the origin, middle finger up to y = 1, palm towards +z; from
///   500 bust               head, neck and shoulders on a flat base, face towards +z; from 500
/// @throws InputError for an unknown shape, too few vertices, or more than max_sample_vertices.
Mesh make_sample(const std::string& shape, size_t vertices);

/// The outermost points of the sample hand's thumb, index, middle, ring and little finger, on its implicit
/// surface (the mesh is off by its own coarseness).
std::vector<Vec3> hand_finger_tips();

} // namespace anvil
