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

/// A face of the file with where it was when it was picked.
struct PickedFace {
    WholeFaceAddress at;
    Vec3 position{0};
};

/// A line along the surface through places, and what joins them once that is known.
struct PickedLine {
    std::vector<PickedPlace> points;
    std::vector<Vec3> path; ///< empty: not known

    std::vector<SurfaceAddress> addresses() const;
    /// The path, else the points.
    std::vector<Vec3> places() const;
};

struct PickedHandle {
    PickedPlace place;
    Vec3 by{0};
    double degrees = 0;
    std::vector<PickedPlace> anchors;
    std::vector<PickedFace> anchor_faces;
    std::vector<PickedLine> anchor_lines;
    std::vector<Vec3> way{}; ///< offsets that it was dragged through, where the path counts; else empty

    bool has_anchors() const { return !anchors.empty() || !anchor_faces.empty() || !anchor_lines.empty(); }
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
