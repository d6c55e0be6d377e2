// What is selected, as a recipe writes it.
#pragma once

#include "app/viewer/picked.h"
#include "app/viewer/selection.h"
#include "engine/forge/surface_version.h"

#include <span>
#include <vector>

namespace anvil {

/// Vertices of the surface as the file's vertices, or where refinement added them as places on the file's
/// faces. O(mesh). `pick` of the same surface.
std::vector<PickedPlace> places_of(const SurfaceVersion& surface, std::span<const uint32_t> vertices,
                                   const PickSurface& pick);

struct SelectedPlaces {
    std::vector<PickedFace> faces;
    std::vector<PickedPlace> places;
};

/// The file's faces that a wholly selected face is or is part of, each once, and the selected vertices that
/// none of these has. O(mesh).
SelectedPlaces faces_and_places_of(const SurfaceVersion& surface, const Selection& selection,
                                   const PickSurface& pick);

} // namespace anvil
