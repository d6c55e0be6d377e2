#include "engine/mesh/incidence.h"

namespace anvil {

Incidence incident_triangles(std::span<const Triangle> triangles, size_t vertex_count) {
    Incidence result;
    std::vector<uint32_t> end(vertex_count + 2, 0); // of the vertex before, so that filling makes it `begin`
    for (const Triangle& t : triangles) {
        for (const uint32_t v : t) {
            ++end[v + 2];
        }
    }
    for (size_t v = 2; v < end.size(); ++v) {
        end[v] += end[v - 1];
    }
    result.triangles.resize(3 * triangles.size());
    for (uint32_t f = 0; f < triangles.size(); ++f) {
        for (const uint32_t v : triangles[f]) {
            result.triangles[end[v + 1]++] = f;
        }
    }
    end.pop_back();
    result.begin = std::move(end);
    return result;
}

} // namespace anvil
