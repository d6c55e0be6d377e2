// Flipped faces of a surface, turned back, and those that are there twice, left out.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// The triangles, each turned over (its last two corners exchanged) that lies the other way round than the
/// larger part, by area, of the surface that edges of two triangles join it to (not the same one twice).
/// Surfaces that cannot be oriented, as a Moebius strip, stay as they are. Vertices at equal positions count
/// as one. O(t log t)
std::vector<Triangle> oriented_alike(std::span<const Vec3> positions, std::span<const Triangle> triangles);

/// The triangles without those that are there already, with the same corners the same way round. Vertices at
/// equal positions count as one. O(t log t)
std::vector<Triangle> each_once(std::span<const Vec3> positions, std::span<const Triangle> triangles);

} // namespace anvil
