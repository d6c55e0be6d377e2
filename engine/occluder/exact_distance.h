// The true signed distance of an occluder in its own space: what fields are baked from, and what decides at
// the end whether a vertex is inside.
#pragma once

#include "engine/core/types.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/kernel_types.h"

#include <memory>
#include <span>
#include <vector>

namespace anvil {

class SearchDevice; // engine/mesh/triangle_search.h

struct SignedDistance {
    double distance; ///< < 0 inside
    Vec3 normal;     ///< outward unit normal: from the closest surface point, or towards it when inside
};

/// Asks a solid for the distances of many points, on one thread.
class DistanceTracer {
  public:
    virtual ~DistanceTracer() = default;
    /// Of the same number as `found`; quick where each is near the one before.
    virtual void trace(std::span<const Vec3> points, std::span<SignedDistance> found) = 0;
};

/// Thread-safe; built once. Whatever can be asked for signed distances is baked, finished and probed through
/// this alone.
class ExactDistance {
  public:
    virtual ~ExactDistance() = default;
    virtual SignedDistance at(const Vec3& p) const = 0;
    /// Which the solid outlives.
    virtual std::unique_ptr<DistanceTracer> tracer() const;
    /// The same on all cores, with the device's help, for many thousands of points at once; nullptr: nothing
    /// that a device would help with. Both outlive it. @throws DeviceError, as do its calls
    virtual std::unique_ptr<DistanceTracer> tracer_with(SearchDevice& /*device*/) const { return nullptr; }
    /// Box of the solid; infinite for unbounded shapes.
    virtual Box bounds() const = 0;
};

/// Distance by the nodes' formulas: exact for one analytic leaf, for several a bound with exact sign and zero
/// set (no volume leaves).
std::shared_ptr<const ExactDistance> formula_distance(std::vector<kernel::f64::ShapeNode> nodes);

/// Triangle mesh of a bounded solid's surface with its sharp edges, in its own space; empty for an empty
/// solid. `cells` polygonization cells along the longest side of its bounds.
Mesh surface_of(const ExactDistance& solid, int cells);

/// True distance of a bounded Boolean combination: closest point of a fine polygonization of the zero set,
/// put on the zero set of the formula (`cells` polygonization cells along the longest side).
/// @throws InputError if the solid is unbounded or empty.
std::shared_ptr<const ExactDistance> redistanced(std::shared_ptr<const ExactDistance> solid, int cells);

} // namespace anvil
