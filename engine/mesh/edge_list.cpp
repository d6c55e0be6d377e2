#include "engine/mesh/edge_list.h"

#include <numeric>

namespace anvil {

namespace {

template <typename Body>
void for_each_side(const Mesh& mesh, const Body& body) {
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const uint32_t first = mesh.polygon_begin[f];
        const uint32_t last = mesh.polygon_begin[f + 1] - 1;
        for (uint32_t c = first; c <= last; ++c) {
            const uint32_t next = c == last ? first : c + 1;
            if (mesh.corners[c] != mesh.corners[next]) {
                body(c, next);
            }
        }
    }
}

} // namespace

EdgeList list_edges(const Mesh& mesh) {
    EdgeList list;
    list.begin.assign(mesh.vertex_count() + 1, 0);
    for_each_side(mesh, [&](uint32_t c, uint32_t next) {
        ++list.begin[std::min(mesh.corners[c], mesh.corners[next]) + 1];
    });
    std::partial_sum(list.begin.begin(), list.begin.end(), list.begin.begin());
    list.uses.resize(list.begin.back());
    std::vector<uint32_t> cursor(list.begin.begin(), list.begin.end() - 1);
    for_each_side(mesh, [&](uint32_t c, uint32_t next) {
        const uint32_t from = mesh.corners[c];
        const uint32_t to = mesh.corners[next];
        list.uses[cursor[std::min(from, to)]++] =
            from < to ? EdgeUse{to, c, next, true} : EdgeUse{from, next, c, false};
    });
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        std::sort(list.uses.begin() + list.begin[v], list.uses.begin() + list.begin[v + 1],
                  [](const EdgeUse& a, const EdgeUse& b) {
                      return a.high != b.high ? a.high < b.high : a.low_corner < b.low_corner;
                  });
    }
    return list;
}

} // namespace anvil
