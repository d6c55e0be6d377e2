// From the cursor's way in the window to how far a handle is moved or turned.
#pragma once

#include "app/viewer/orbit_camera.h"

#include <optional>

namespace anvil {

/// What a drag is held to.
struct DragConstraint {
    enum class Kind : uint8_t { view, axis, plane };

    Kind kind = Kind::view;
    Vec3 direction{0}; ///< axis: along it; plane: its normal; not zero, need not be unit

    bool operator==(const DragConstraint&) const = default;
};

/// A place in the window.
struct Cursor {
    double x = 0;
    double y = 0;
};

/// The displacement of a handle that started at `start` (world) when the cursor goes between two places: in
/// the plane through it that faces the eye, or where the constraint lets it go to. Where the eye looks along
/// an axis or a plane, what the window shows of it counts.
Vec3 dragged(const OrbitCamera& camera, const Vec3& start, const Cursor& from, const Cursor& to,
             const DragConstraint& constraint);

/// Degrees, counterclockwise seen against `axis`, by which the cursor goes about `centre` (world): from -180
/// to 180. Near the centre, where no angle can be told, 0.
double turned(const OrbitCamera& camera, const Vec3& centre, const Vec3& axis, const Cursor& from,
              const Cursor& to);

/// The nearest multiple of the step. @pre step > 0
double to_multiple(double value, double step);

/// A round length that fits a scene of this size: 1, 2 or 5 times a power of ten, about a hundredth of it.
double round_step(double size);

} // namespace anvil
