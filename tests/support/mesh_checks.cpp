#include "tests/support/mesh_checks.h"

#include <numeric>
#include <utility>

namespace anvil::test {

namespace {

/// Number of fans that each vertex's triangles form: sets of triangles connected through edges at the vertex.
size_t count_bow_ties(const Mesh& mesh) {
    std::vector<std::vector<uint32_t>> incident(mesh.vertex_count());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const uint32_t v : mesh.triangles[t]) {
            incident[v].push_back(t);
        }
    }
    size_t bow_ties = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        std::vector<char> reached(incident[v].size(), 0);
        std::vector<size_t> stack;
        size_t fans = 0;
        for (size_t start = 0; start < incident[v].size(); ++start) {
            if (reached[start]) {
                continue;
            }
            ++fans;
            stack.assign(1, start);
            reached[start] = 1;
            while (!stack.empty()) {
                const Triangle& t = mesh.triangles[incident[v][stack.back()]];
                stack.pop_back();
                for (size_t other = 0; other < incident[v].size(); ++other) {
                    const Triangle& u = mesh.triangles[incident[v][other]];
                    int shared = 0;
                    for (const uint32_t a : t) {
                        shared += a != v && (a == u[0] || a == u[1] || a == u[2]);
                    }
                    if (!reached[other] && shared > 0) {
                        reached[other] = 1;
                        stack.push_back(other);
                    }
                }
            }
        }
        bow_ties += fans > 1;
    }
    return bow_ties;
}

double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::atan2(glm::length(glm::cross(b - a, c - a)), glm::dot(b - a, c - a)) * 180 / 3.14159265358979;
}

size_t count_components(const Mesh& mesh, const std::vector<char>& used) {
    std::vector<uint32_t> parent(mesh.vertex_count());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](uint32_t v) {
        while (parent[v] != v) {
            v = parent[v] = parent[parent[v]];
        }
        return v;
    };
    for (const Triangle& t : mesh.triangles) {
        parent[root(t[1])] = root(t[0]);
        parent[root(t[2])] = root(t[0]);
    }
    size_t components = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        components += used[v] && root(v) == v;
    }
    return components;
}

} // namespace

MeshFacts facts_of(const Mesh& mesh) {
    MeshFacts facts;
    std::vector<std::pair<uint32_t, uint32_t>> edges; // from, to
    std::vector<char> used(mesh.vertex_count(), 0);
    facts.min_angle = 180;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 p[3] = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
        facts.volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
        facts.degenerate_triangles += t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
                                      !(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) > 0);
        for (int i = 0; i < 3; ++i) {
            const uint32_t a = t[i];
            const uint32_t b = t[(i + 1) % 3];
            used[a] = 1;
            edges.emplace_back(a, b);
            facts.min_angle = std::min(facts.min_angle, angle_at(p[i], p[(i + 1) % 3], p[(i + 2) % 3]));
        }
    }
    std::sort(edges.begin(), edges.end());
    size_t count = 0;
    for (size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = edges[i];
        const bool back = std::binary_search(edges.begin(), edges.end(), std::pair(b, a));
        const bool repeated = i > 0 && edges[i] == edges[i - 1];
        facts.boundary_edges += !back && !repeated;
        facts.non_manifold_edges += repeated;
        count += (a < b || !back) && !repeated;
    }
    for (const char u : used) {
        facts.isolated_vertices += !u;
    }
    facts.bow_tie_vertices = count_bow_ties(mesh);
    facts.components = count_components(mesh, used);
    facts.euler = static_cast<long>(mesh.vertex_count()) - static_cast<long>(count) +
                  static_cast<long>(mesh.triangles.size());
    return facts;
}

} // namespace anvil::test
