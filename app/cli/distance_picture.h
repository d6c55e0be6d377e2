// Distances as a picture.
#pragma once

#include "app/cli/picture_options.h"
#include "engine/mesh/mesh.h"

#include <vector>

namespace anvil {

/// A round length, 1, 2 or 5 times a power of ten, that goes 12 to 30 times into `farthest` > 0.
double isoline_spacing(double farthest);

/// The mesh coloured by distance (one per vertex) with lines of equal distance every isoline_spacing(), grey
/// where a face is not reached as a whole, and a ball at each of `sources`. @throws DeviceError, WriteError
void draw_distances(Device& device, const Mesh& mesh, const std::vector<double>& distances,
                    const std::vector<Vec3>& sources, const PictureOptions& options);

/// The largest finite one; 0 if there is none.
double farthest_of(const std::vector<double>& distances);

} // namespace anvil
