// A surface as what an edit changed of the one before it: a drag of a region takes the memory of the region.
#pragma once

#include "engine/forge/surface_version.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace anvil {

/// What vertices have beside their place.
struct VertexState {
    float weight = 0;
    bool moved = false;
    bool touching = false;
};

/// Between the surface before an edit and the one after it; leads both ways.
struct SurfaceDifference {
    std::shared_ptr<const SurfaceVersion> before, after; ///< their vectors over vertices are empty
    std::vector<uint32_t> vertices; ///< of which any bit differs, ascending; then those that are new
    std::vector<Vec3> old_positions, new_positions;
    std::vector<VertexState> old_states, new_states; ///< of new vertices there are no old ones
};

/// Nothing where it would take about as much memory as `after` does. Both hold as many values as vertices;
/// `after` has those of `before`, and may have more behind them.
std::optional<SurfaceDifference> difference(const SurfaceVersion& before, const SurfaceVersion& after);

/// `surface`, which is the one before, becomes the one after, bit for bit.
void apply(const SurfaceDifference& change, SurfaceVersion& surface);
/// `surface`, which is the one after, becomes the one before, bit for bit.
void take_back(const SurfaceDifference& change, SurfaceVersion& surface);

/// What it takes in memory beside meshes.
size_t own_bytes(const SurfaceDifference& change);

} // namespace anvil
