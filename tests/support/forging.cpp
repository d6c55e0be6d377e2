#include "tests/support/forging.h"

#include <charconv>

namespace anvil::test {

std::string text(double x) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x).ptr;
    return {buffer, end};
}

std::string text(const Vec3& v) {
    return "[" + text(v.x) + "," + text(v.y) + "," + text(v.z) + "]";
}

uint32_t nearest_vertex(const Mesh& mesh, const Vec3& p) {
    uint32_t best = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (glm::length(mesh.positions[v] - p) < glm::length(mesh.positions[best] - p)) {
            best = v;
        }
    }
    return best;
}

} // namespace anvil::test
