// Enclosed volume before and after an edit.
#pragma once

#include "engine/forge/report.h"
#include "engine/mesh/mesh.h"

#include <optional>
#include <span>

namespace anvil {

/// Signed volumes enclosed by the mesh with its vertices at `before` and at `after` (world units cubed), or
/// nothing if the mesh is open: some edge has not exactly as many faces in one direction as in the other.
std::optional<VolumeChange> volume_change(const Mesh& mesh, std::span<const Vec3> before,
                                          std::span<const Vec3> after);

} // namespace anvil
