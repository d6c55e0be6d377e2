// Distances as a picture.
#pragma once

#include "app/cli/picture_options.h"
#include "engine/mesh/mesh.h"

#include <vector>

namespace anvil {

/// The mesh coloured from orange (0) to blue (the largest finite distance) with twelve dark bands; grey where
/// the distance is infinite. @throws DeviceError, WriteError
void draw_distances(Device& device, const Mesh& mesh, const std::vector<double>& distances,
                    const PictureOptions& options);

} // namespace anvil
