// The picture of a forged mesh: the surface with its region tinted, the occluders translucent.
#pragma once

#include "engine/core/progress.h"
#include "engine/edit/recipe.h"
#include "engine/forge/forge.h"
#include "engine/gpu/device.h"
#include "engine/gpu/picture.h"
#include "engine/mesh/mesh.h"

namespace anvil {

/// @throws DeviceError if the device cannot draw.
Picture forge_picture(Device& device, const Mesh& mesh, const Recipe& recipe, const ForgeResult& result,
                      const PictureView& view, PictureSize size, Progress& progress);

} // namespace anvil
