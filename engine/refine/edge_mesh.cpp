#include "engine/refine/edge_mesh.h"

#include <numeric>

namespace anvil {

namespace {

struct Side {
    uint32_t high;
    uint32_t number; ///< 3 * face + corner
};

/// The sides of all faces, those with the same lower end together.
struct SideTable {
    std::vector<uint32_t> begin;
    std::vector<Side> sides;
};

SideTable sort_sides(const std::vector<EdgeMesh::Face>& faces, size_t vertex_count) {
    SideTable table;
    table.begin.assign(vertex_count + 1, 0);
    const auto for_each_side = [&](const auto& body) {
        for (uint32_t f = 0; f < faces.size(); ++f) {
            for (uint32_t i = 0; i < 3; ++i) {
                const uint32_t from = faces[f].corners[i];
                const uint32_t to = faces[f].corners[i == 2 ? 0 : i + 1];
                if (from != to) {
                    body(std::min(from, to), Side{std::max(from, to), 3 * f + i});
                }
            }
        }
    };
    for_each_side([&](uint32_t low, const Side&) { ++table.begin[low + 1]; });
    std::partial_sum(table.begin.begin(), table.begin.end(), table.begin.begin());
    table.sides.resize(table.begin.back());
    std::vector<uint32_t> cursor(table.begin.begin(), table.begin.end() - 1);
    for_each_side([&](uint32_t low, const Side& side) { table.sides[cursor[low]++] = side; });
    return table;
}

} // namespace

EdgeMesh::EdgeMesh(std::span<const Triangle> all, std::span<const uint32_t> chosen, size_t vertex_count) {
    faces_.reserve(chosen.size());
    for (const uint32_t t : chosen) {
        faces_.push_back({all[t], {no_index, no_index, no_index}, t});
    }
    SideTable table = sort_sides(faces_, vertex_count);
    edges_.reserve(table.sides.size() / 2 + 1);
    for (uint32_t v = 0; v < vertex_count; ++v) {
        const auto first = table.sides.begin() + table.begin[v];
        const auto last = table.sides.begin() + table.begin[v + 1];
        std::sort(first, last, [](const Side& x, const Side& y) {
            return x.high != y.high ? x.high < y.high : x.number < y.number;
        });
        for (auto side = first; side != last; ++side) {
            if (side == first || side->high != (side - 1)->high) {
                edges_.push_back({v, side->high, no_index, no_index});
            }
            faces_[side->number / 3].edges[side->number % 3] = static_cast<uint32_t>(edges_.size() - 1);
        }
    }
}

void EdgeMesh::mark(uint32_t edge, uint32_t middle) {
    edges_[edge].middle = middle;
    edges_[edge].halves = static_cast<uint32_t>(edges_.size());
    const Edge whole = edges_[edge];
    edges_.push_back({whole.a, middle, no_index, no_index});
    edges_.push_back({middle, whole.b, no_index, no_index});
}

uint32_t EdgeMesh::new_edge(uint32_t a, uint32_t b) {
    if (a == b) {
        return no_index;
    }
    edges_.push_back({a, b, no_index, no_index});
    return static_cast<uint32_t>(edges_.size() - 1);
}

uint32_t EdgeMesh::half_at(uint32_t edge, uint32_t end) const {
    return edges_[edge].halves + (edges_[edge].a == end ? 0 : 1);
}

void EdgeMesh::put(uint32_t slot, const Triangle& corners, const Triangle& edges, uint32_t root) {
    if (slot == faces_.size()) {
        faces_.emplace_back();
    }
    faces_[slot] = {corners, edges, root};
}

/// Corner names of the patterns: a, b, c in order, starting where `at` says; p on ab, q on bc, r on ca.
void EdgeMesh::split_one(uint32_t face, int at) {
    const Face f = faces_[face];
    const uint32_t a = f.corners[at], b = f.corners[(at + 1) % 3], c = f.corners[(at + 2) % 3];
    const uint32_t ab = f.edges[at], bc = f.edges[(at + 1) % 3], ca = f.edges[(at + 2) % 3];
    const uint32_t p = edges_[ab].middle;
    const uint32_t pc = new_edge(p, c);
    put(face, {a, p, c}, {half_at(ab, a), pc, ca}, f.root);
    put(static_cast<uint32_t>(faces_.size()), {p, b, c}, {half_at(ab, b), bc, pc}, f.root);
}

/// `whole`: the edge that is not split, bc; the corner a between the split ones is cut off.
void EdgeMesh::split_two(uint32_t face, int whole, const Diagonal& first_diagonal) {
    const Face f = faces_[face];
    const uint32_t b = f.corners[whole], c = f.corners[(whole + 1) % 3], a = f.corners[(whole + 2) % 3];
    const uint32_t bc = f.edges[whole], ca = f.edges[(whole + 1) % 3], ab = f.edges[(whole + 2) % 3];
    const uint32_t p = edges_[ab].middle;
    const uint32_t r = edges_[ca].middle;
    const uint32_t pr = new_edge(p, r);
    const auto next = static_cast<uint32_t>(faces_.size());
    put(face, {a, p, r}, {half_at(ab, a), pr, half_at(ca, a)}, f.root);
    if (first_diagonal(p, b, c, r)) {
        const uint32_t pc = new_edge(p, c);
        put(next, {p, b, c}, {half_at(ab, b), bc, pc}, f.root);
        put(next + 1, {p, c, r}, {pc, half_at(ca, c), pr}, f.root);
    } else {
        const uint32_t br = new_edge(b, r);
        put(next, {p, b, r}, {half_at(ab, b), br, pr}, f.root);
        put(next + 1, {b, c, r}, {bc, half_at(ca, c), br}, f.root);
    }
}

void EdgeMesh::split_three(uint32_t face) {
    const Face f = faces_[face];
    const auto [a, b, c] = f.corners;
    const auto [ab, bc, ca] = f.edges;
    const uint32_t p = edges_[ab].middle;
    const uint32_t q = edges_[bc].middle;
    const uint32_t r = edges_[ca].middle;
    const uint32_t pq = new_edge(p, q);
    const uint32_t qr = new_edge(q, r);
    const uint32_t rp = new_edge(r, p);
    const auto next = static_cast<uint32_t>(faces_.size());
    put(face, {p, q, r}, {pq, qr, rp}, f.root);
    put(next, {a, p, r}, {half_at(ab, a), rp, half_at(ca, a)}, f.root);
    put(next + 1, {p, b, q}, {half_at(ab, b), half_at(bc, b), pq}, f.root);
    put(next + 2, {r, q, c}, {qr, half_at(bc, c), half_at(ca, c)}, f.root);
}

std::vector<uint32_t> EdgeMesh::split(std::span<const uint32_t> candidates, const Diagonal& first_diagonal) {
    std::vector<uint32_t> changed;
    for (const uint32_t face : candidates) {
        int count = 0;
        int split_side = 0;
        int whole_side = 0;
        for (int i = 0; i < 3; ++i) {
            const uint32_t edge = faces_[face].edges[i];
            if (edge != no_index && is_split(edge)) {
                ++count;
                split_side = i;
            } else {
                whole_side = i;
            }
        }
        if (count == 0) {
            continue;
        }
        const auto first = static_cast<uint32_t>(faces_.size());
        if (count == 1) {
            split_one(face, split_side);
        } else if (count == 2) {
            split_two(face, whole_side, first_diagonal);
        } else {
            split_three(face);
        }
        changed.push_back(face);
        for (uint32_t f = first; f < faces_.size(); ++f) {
            changed.push_back(f);
        }
    }
    return changed;
}

} // namespace anvil
