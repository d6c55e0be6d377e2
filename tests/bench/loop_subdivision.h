// Smooth meshes of any size out of small ones.
#pragma once

#include "engine/mesh/mesh.h"

#include <map>
#include <utility>
#include <vector>

namespace anvil {

/// Each triangle cut into four by Loop's rule (Loop 1987, with Warren's weights); edges that do not have just
/// two triangles are taken as straight boundaries, and their ends stay.
inline Mesh loop_subdivided(const Mesh& mesh) {
    struct Edge {
        uint32_t vertex = 0, faces = 0;
        Vec3 opposite{0};
    };
    std::map<std::pair<uint32_t, uint32_t>, Edge> edges;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            Edge& edge = edges[std::minmax(t[k], t[(k + 1) % 3])];
            ++edge.faces;
            edge.opposite += mesh.positions[t[(k + 2) % 3]];
        }
    }
    Mesh finer;
    std::vector<Vec3> sums(mesh.vertex_count(), Vec3(0));
    std::vector<uint32_t> counts(mesh.vertex_count());
    std::vector<bool> stays(mesh.vertex_count());
    finer.positions.resize(mesh.vertex_count());
    for (auto& [ends, edge] : edges) {
        const auto [a, b] = ends;
        const Vec3 sum = mesh.positions[a] + mesh.positions[b];
        edge.vertex = static_cast<uint32_t>(finer.positions.size());
        finer.positions.push_back(edge.faces == 2 ? 0.375 * sum + 0.125 * edge.opposite : 0.5 * sum);
        for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
            sums[v] += mesh.positions[other];
            ++counts[v];
            stays[v] = stays[v] || edge.faces != 2;
        }
    }
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const double n = counts[v], share = n == 3 ? 3.0 / 16 : 3 / (8 * n);
        finer.positions[v] = counts[v] == 0 || stays[v]
                                 ? mesh.positions[v]
                                 : (1 - n * share) * mesh.positions[v] + share * sums[v];
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        const uint32_t ab = edges[std::minmax(a, b)].vertex, bc = edges[std::minmax(b, c)].vertex,
                       ca = edges[std::minmax(c, a)].vertex;
        for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            finer.add_polygon(t);
            finer.triangles.push_back(t);
        }
    }
    return finer;
}

} // namespace anvil
