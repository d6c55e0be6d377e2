// What a person has picked of an edit: places, and handles with where they are moved to.
#pragma once

#include "app/viewer/pick_surface.h"
#include "engine/edit/recipe.h"

#include <vector>

namespace anvil {

/// A picked place with where it was when it was picked.
struct PickedPlace {
    SurfaceAddress at;
    Vec3 position{0};
    Vec3 normal{0};
};

PickedPlace place_of(const SurfaceHit& hit);

struct PickedHandle {
    PickedPlace place;
    Vec3 by{0};
    double degrees = 0;
    std::vector<PickedPlace> anchors;
};

/// The handles of one edit and how they move.
struct PickedHandles {
    std::vector<PickedHandle> all;
    size_t active = 0;  ///< the one that a drag moves
    bool turns = false; ///< the edit is a rotation about
    Axis axis;

    /// Where a handle is wanted.
    Vec3 target(const PickedHandle& handle) const;
    /// What the handles turn about: the anchors' middle, or the first handle without any. @pre not empty
    Vec3 centre() const;
};

} // namespace anvil
