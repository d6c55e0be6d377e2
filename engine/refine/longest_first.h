// Splits that would leave slivers give way to a split of their face's longest edge.
#pragma once

#include "engine/refine/edge_mesh.h"

namespace anvil {

/// A place at which an edge is to be split.
struct EdgeSplit {
    uint32_t edge = 0;
    double place = 0;
    double error = 0;
    uint32_t crease = no_index; ///< the one that is there
};

struct GivenWay {
    std::vector<uint32_t> later;   ///< edges that were not split now: to be looked at again
    std::vector<uint32_t> blocked; ///< edges that cannot be split, since their face's longest edge cannot
};

/// In faces lower over their longest edge than `thinnest` of its length, edges that are to be split give way
/// to the longest one, which is split in its middle; and so on with the face beyond. Splits on creases stay.
/// @param candidates the faces that have an edge to be split.
/// @param fixed per edge: not 0 where it cannot be split.
GivenWay put_longest_first(const EdgeMesh& mesh, std::span<const uint32_t> candidates,
                           std::span<const Vec3> positions, double thinnest, const std::vector<char>& fixed,
                           std::vector<EdgeSplit>& splits);

} // namespace anvil
