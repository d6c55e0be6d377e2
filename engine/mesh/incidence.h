// Which triangles meet at each vertex.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// A triangle appears once for each of its corners, in ascending order.
struct Incidence {
    std::vector<uint32_t> begin;     ///< n + 1: runs of `triangles`
    std::vector<uint32_t> triangles; ///< 3 for each triangle

    std::span<const uint32_t> at(uint32_t vertex) const {
        return {triangles.data() + begin[vertex], triangles.data() + begin[vertex + 1]};
    }
};

/// O(vertices + triangles). Indices must be below `vertex_count`.
Incidence incident_triangles(std::span<const Triangle> triangles, size_t vertex_count);

} // namespace anvil
