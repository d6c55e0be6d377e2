// Distances between bounds that know nothing of windows: shortest paths over graphs on the edges.
#pragma once

#include "engine/mesh/mesh.h"

#include <map>
#include <queue>

namespace anvil::surfaces {

struct Piece {
    Vec3 from, to;
};

inline double to_piece(const Vec3& p, const Piece& piece) {
    const Vec3 along = piece.to - piece.from;
    const double squared = glm::dot(along, along);
    const double t = squared > 0 ? std::clamp(glm::dot(p - piece.from, along) / squared, 0.0, 1.0) : 0;
    return glm::length(p - piece.from - t * along);
}

/// Pieces of the rim of one triangle do not cross: one end at least of the shortest line between them is an
/// end.
inline double between(const Piece& a, const Piece& b) {
    return std::min({to_piece(a.from, b), to_piece(a.to, b), to_piece(b.from, a), to_piece(b.to, a)});
}

/// Distances of the vertices over a graph with the vertices and `pieces` nodes on every edge, joined straight
/// across each triangle. Nodes that are points give the lengths of true paths: never less than the distance.
/// Nodes that are whole pieces of the edges, as near as any two of their points, let every path pass through
/// what it crosses: never more than the distance. The two meet as pieces are added. (A straight path leaves
/// an edge that it crosses; pieces of the same edge are not joined, or one could slide along it for nothing.)
inline std::vector<double> graph_distances(const Mesh& mesh, uint32_t source, int pieces, bool whole) {
    std::vector<Piece> nodes;
    for (const Vec3& p : mesh.positions) {
        nodes.push_back({p, p});
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> first;
    struct Member {
        uint32_t node;
        unsigned edges; ///< of the triangle that it lies on, as bits
    };
    std::vector<std::vector<Member>> groups;
    for (const Triangle& t : mesh.triangles) {
        std::vector<Member> group = {{t[0], 0b101}, {t[1], 0b011}, {t[2], 0b110}};
        for (int k = 0; k < 3; ++k) {
            const std::pair<uint32_t, uint32_t> edge = std::minmax(t[k], t[(k + 1) % 3]);
            const auto [it, fresh] = first.try_emplace(edge, static_cast<uint32_t>(nodes.size()));
            const auto at = [&](double part) {
                return glm::mix(mesh.positions[edge.first], mesh.positions[edge.second], part);
            };
            for (int i = 0; i < pieces; ++i) {
                if (fresh) {
                    const Vec3 point = at((i + 1.0) / (pieces + 1));
                    nodes.push_back(whole ? Piece{at(double(i) / pieces), at((i + 1.0) / pieces)}
                                          : Piece{point, point});
                }
                group.push_back({it->second + i, 1U << k});
            }
        }
        groups.push_back(group);
    }
    struct Place {
        uint32_t group;
        unsigned edges;
    };
    std::vector<std::vector<Place>> of_node(nodes.size());
    for (uint32_t g = 0; g < groups.size(); ++g) {
        for (const Member& member : groups[g]) {
            of_node[member.node].push_back({g, member.edges});
        }
    }
    std::vector<double> distance(nodes.size(), infinity);
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
    distance[source] = 0;
    heap.emplace(0, source);
    while (!heap.empty()) {
        const auto [d, v] = heap.top();
        heap.pop();
        if (d > distance[v]) {
            continue;
        }
        for (const Place& here : of_node[v]) {
            for (const auto& [w, edges] : groups[here.group]) {
                const bool vertices = std::max(v, w) < mesh.vertex_count();
                if (((here.edges & edges) != 0 && !vertices) || d >= distance[w]) {
                    continue;
                }
                const double through = d + between(nodes[v], nodes[w]);
                if (through < distance[w]) {
                    distance[w] = through;
                    heap.emplace(through, w);
                }
            }
        }
    }
    distance.resize(mesh.vertex_count());
    return distance;
}

} // namespace anvil::surfaces
