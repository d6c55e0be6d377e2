#include "engine/mesh/triangle_net.h"

#include "engine/core/error.h"
#include "engine/mesh/triangle_mesh.h"

namespace anvil {

TriangleNet::TriangleNet(const Mesh& mesh) : positions(mesh.positions) {
    connect(mesh.triangles);
}

void TriangleNet::connect(std::span<const Triangle> triangles) {
    const auto count = static_cast<uint32_t>(3 * triangles.size());
    to_.resize(count);
    twin_.assign(count, no_index);
    leaving_.assign(positions.size(), no_index);
    free_faces_.clear();
    face_count_ = triangles.size();
    for (uint32_t h = 0; h < count; ++h) {
        to_[h] = triangles[h / 3][(h + 1) % 3];
        leaving_[triangles[h / 3][h % 3]] = h;
    }
    pair_all();
    vertex_count_ = 0;
    size_t reached = 0;
    for (uint32_t v = 0; v < vertex_slots(); ++v) {
        if (has_vertex(v)) {
            ++vertex_count_;
            reached += degree(v);
        }
    }
    if (reached != count) {
        throw InputError("remeshing needs a manifold surface; some vertices join several fans of triangles");
    }
}

void TriangleNet::pair_all() {
    struct Edge {
        uint64_t ends; ///< lower vertex, higher vertex
        uint32_t half_edge;
    };
    std::vector<Edge> edges(to_.size());
    for (uint32_t h = 0; h < half_edge_count(); ++h) {
        const auto [low, high] = std::minmax({from(h), to(h)});
        edges[h] = {static_cast<uint64_t>(low) << 32 | high, h};
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge;
    });
    for (size_t i = 0; i < edges.size(); i += 2) {
        const uint32_t h = edges[i].half_edge;
        const bool paired = i + 1 < edges.size() && edges[i].ends == edges[i + 1].ends &&
                            from(h) == to(edges[i + 1].half_edge) && from(h) != to(h) &&
                            (i + 2 >= edges.size() || edges[i].ends != edges[i + 2].ends);
        if (!paired) {
            throw InputError("remeshing needs a closed manifold surface; the edge between vertices " +
                             std::to_string(from(h)) + " and " + std::to_string(to(h)) +
                             " does not lie between two triangles of the same orientation");
        }
        pair(h, edges[i + 1].half_edge);
    }
}

void TriangleNet::pair(uint32_t a, uint32_t b) {
    twin_[a] = b;
    twin_[b] = a;
}

void TriangleNet::set_face(uint32_t face, const Triangle& corners) {
    for (uint32_t k = 0; k < 3; ++k) {
        to_[3 * face + k] = corners[(k + 1) % 3];
        leaving_[corners[k]] = 3 * face + k;
    }
}

uint32_t TriangleNet::new_face() {
    ++face_count_;
    if (!free_faces_.empty()) {
        const uint32_t face = free_faces_.back();
        free_faces_.pop_back();
        return face;
    }
    to_.resize(to_.size() + 3, no_index);
    twin_.resize(to_.size(), no_index);
    return static_cast<uint32_t>(to_.size() / 3 - 1);
}

size_t TriangleNet::degree(uint32_t v) const {
    size_t count = 0;
    around(v, [&](uint32_t) { ++count; });
    return count;
}

bool TriangleNet::are_neighbours(uint32_t a, uint32_t b) const {
    bool found = false;
    around(a, [&](uint32_t h) { found = found || to_[h] == b; });
    return found;
}

Vec3 TriangleNet::face_normal(uint32_t h) const {
    const Vec3& a = positions[from(h)];
    return glm::cross(positions[to(h)] - a, positions[apex(h)] - a);
}

uint32_t TriangleNet::split(uint32_t h, const Vec3& p) {
    const uint32_t g = twin_[h];
    const uint32_t a = from(h);
    const uint32_t b = to(h);
    const uint32_t c = apex(h);
    const uint32_t d = apex(g);
    const uint32_t bc = twin_[next(h)];
    const uint32_t ca = twin_[previous(h)];
    const uint32_t ad = twin_[next(g)];
    const uint32_t db = twin_[previous(g)];
    const uint32_t m = vertex_slots();
    positions.push_back(p);
    leaving_.push_back(no_index);
    ++vertex_count_;
    const uint32_t f0 = h / 3;
    const uint32_t f1 = g / 3;
    const uint32_t f2 = new_face();
    const uint32_t f3 = new_face();
    set_face(f0, {a, m, c});
    set_face(f1, {m, a, d});
    set_face(f2, {m, b, c});
    set_face(f3, {b, m, d});
    pair(3 * f0, 3 * f1);
    pair(3 * f2, 3 * f3);
    pair(3 * f0 + 1, 3 * f2 + 2);
    pair(3 * f1 + 2, 3 * f3 + 1);
    pair(3 * f0 + 2, ca);
    pair(3 * f1 + 1, ad);
    pair(3 * f2 + 1, bc);
    pair(3 * f3 + 2, db);
    return m;
}

bool TriangleNet::can_collapse(uint32_t h) const {
    const uint32_t a = from(h);
    const uint32_t b = to(h);
    const uint32_t c = apex(h);
    const uint32_t d = apex(twin_[h]);
    if (c == d || degree(c) <= 3 || degree(d) <= 3) {
        return false;
    }
    size_t common = 0;
    around(a, [&](uint32_t out) { common += to_[out] != b && are_neighbours(to_[out], b); });
    return common == 2 && degree(a) + degree(b) > 7;
}

void TriangleNet::collapse(uint32_t h) {
    const uint32_t g = twin_[h];
    const uint32_t a = from(h);
    const uint32_t b = to(h);
    const uint32_t c = apex(h);
    const uint32_t d = apex(g);
    const uint32_t bc = twin_[next(h)];
    const uint32_t ca = twin_[previous(h)];
    const uint32_t ad = twin_[next(g)];
    const uint32_t db = twin_[previous(g)];
    around(a, [&](uint32_t out) { to_[twin_[out]] = b; });
    pair(bc, ca);
    pair(ad, db);
    for (const uint32_t face : {h / 3, g / 3}) {
        for (uint32_t k = 0; k < 3; ++k) {
            to_[3 * face + k] = no_index;
        }
        free_faces_.push_back(face);
    }
    leaving_[a] = no_index;
    leaving_[b] = ca; // ran from a to c, runs from b to c now
    leaving_[c] = bc;
    leaving_[d] = ad;
    --vertex_count_;
    face_count_ -= 2;
}

bool TriangleNet::can_flip(uint32_t h) const {
    const uint32_t c = apex(h);
    const uint32_t d = apex(twin_[h]);
    return c != d && degree(from(h)) > 3 && degree(to(h)) > 3 && !are_neighbours(c, d);
}

void TriangleNet::flip(uint32_t h) {
    const uint32_t g = twin_[h];
    const uint32_t a = from(h);
    const uint32_t b = to(h);
    const uint32_t c = apex(h);
    const uint32_t d = apex(g);
    const uint32_t bc = twin_[next(h)];
    const uint32_t ca = twin_[previous(h)];
    const uint32_t ad = twin_[next(g)];
    const uint32_t db = twin_[previous(g)];
    const uint32_t f0 = h / 3;
    const uint32_t f1 = g / 3;
    set_face(f0, {c, d, b});
    set_face(f1, {d, c, a});
    pair(3 * f0, 3 * f1);
    pair(3 * f0 + 1, db);
    pair(3 * f0 + 2, bc);
    pair(3 * f1 + 1, ca);
    pair(3 * f1 + 2, ad);
}

void TriangleNet::quarter() {
    std::vector<uint32_t> middle(to_.size(), no_index);
    for (uint32_t h = 0; h < half_edge_count(); ++h) {
        if (is_alive(h) && middle[h] == no_index) {
            middle[h] = middle[twin_[h]] = vertex_slots();
            positions.push_back(0.5 * (positions[from(h)] + positions[to(h)]));
        }
    }
    std::vector<Triangle> triangles;
    triangles.reserve(4 * face_count_);
    for (uint32_t h = 0; h < half_edge_count(); h += 3) {
        if (is_alive(h)) {
            const std::array<uint32_t, 3> m{middle[h], middle[h + 1], middle[h + 2]};
            triangles.insert(triangles.end(), {Triangle{from(h), m[0], m[2]}, Triangle{m[0], to(h), m[1]},
                                               Triangle{m[2], m[1], apex(h)}, Triangle{m[0], m[1], m[2]}});
        }
    }
    connect(triangles);
}

Mesh TriangleNet::to_mesh() const {
    std::vector<Vec3> kept;
    std::vector<uint32_t> number(positions.size(), no_index);
    for (uint32_t v = 0; v < vertex_slots(); ++v) {
        if (has_vertex(v)) {
            number[v] = static_cast<uint32_t>(kept.size());
            kept.push_back(positions[v]);
        }
    }
    std::vector<Triangle> triangles;
    for (uint32_t h = 0; h < half_edge_count(); h += 3) {
        if (is_alive(h)) {
            triangles.push_back({number[from(h)], number[to(h)], number[apex(h)]});
        }
    }
    return mesh_of_triangles(std::move(kept), std::move(triangles));
}

} // namespace anvil
