#include "engine/occluder/face_orientation.h"

#include "engine/mesh/weld.h"

#include <iterator>
#include <tuple>

namespace anvil {

namespace {

/// An edge of a triangle, as others use it too.
struct EdgeUse {
    uint32_t low;
    uint32_t high;
    uint32_t triangle;
    uint32_t apex; ///< the triangle's other vertex
    bool forward;  ///< from the lower vertex to the higher one
};

struct Neighbour {
    uint32_t triangle = no_index; ///< none across an edge of one triangle, or of more than two
    bool turned = false;          ///< it lies the other way round
};

using Neighbours = std::array<Neighbour, 3>;

std::vector<EdgeUse> sorted_edges(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const std::vector<uint32_t> lowest = first_equal(positions);
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles.size());
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            const uint32_t from = lowest[triangles[t][i]];
            const uint32_t to = lowest[triangles[t][(i + 1) % 3]];
            const uint32_t apex = lowest[triangles[t][(i + 2) % 3]];
            if (from != to) {
                uses.push_back({std::min(from, to), std::max(from, to), t, apex, from < to});
            }
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return uses;
}

std::vector<Neighbours> neighbours_across_edges(const std::vector<EdgeUse>& uses, size_t triangle_count) {
    std::vector<Neighbours> neighbours(triangle_count);
    const auto add = [&](uint32_t triangle, const Neighbour& other) {
        Neighbours& all = neighbours[triangle];
        *std::find_if(all.begin(), all.end(), [](const Neighbour& n) { return n.triangle == no_index; }) =
            other;
    };
    for (size_t i = 0; i < uses.size();) {
        size_t end = i + 1;
        while (end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high) {
            ++end;
        }
        if (end - i == 2 && uses[i].apex != uses[i + 1].apex) { // else the same face twice, at a rim
            const bool turned = uses[i].forward == uses[i + 1].forward;
            add(uses[i].triangle, {uses[i + 1].triangle, turned});
            add(uses[i + 1].triangle, {uses[i].triangle, turned});
        }
        i = end;
    }
    return neighbours;
}

/// Of one surface.
struct Part {
    std::vector<uint32_t> triangles;
    bool orientable = true;
};

class Sides {
  public:
    explicit Sides(const std::vector<Neighbours>& neighbours)
        : neighbours_(neighbours), sides_(neighbours.size(), unknown) {}

    bool is_known(uint32_t triangle) const { return sides_[triangle] != unknown; }
    bool is_turned(uint32_t triangle) const { return sides_[triangle] == turned; }

    /// All that edges join to this triangle.
    Part spread(uint32_t start) {
        Part part{{start}, true};
        sides_[start] = straight;
        for (size_t next = 0; next < part.triangles.size(); ++next) {
            const uint32_t t = part.triangles[next];
            for (const Neighbour& n : neighbours_[t]) {
                if (n.triangle == no_index) {
                    continue;
                }
                const Side side = is_turned(t) != n.turned ? turned : straight;
                if (sides_[n.triangle] == unknown) {
                    sides_[n.triangle] = side;
                    part.triangles.push_back(n.triangle);
                }
                part.orientable = part.orientable && sides_[n.triangle] == side;
            }
        }
        return part;
    }

  private:
    enum Side : uint8_t { unknown, straight, turned };

    const std::vector<Neighbours>& neighbours_;
    std::vector<Side> sides_;
};

} // namespace

std::vector<Triangle> each_once(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    struct Entry {
        Triangle corners; ///< the lowest one first
        uint32_t triangle;
    };
    const std::vector<uint32_t> lowest = first_equal(positions);
    std::vector<Entry> entries;
    entries.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        Triangle corners{lowest[t[0]], lowest[t[1]], lowest[t[2]]};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        entries.push_back({corners, static_cast<uint32_t>(entries.size())});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.triangle < b.triangle;
    });
    const auto end = std::unique(entries.begin(), entries.end(),
                                 [](const Entry& a, const Entry& b) { return a.corners == b.corners; });
    std::sort(entries.begin(), end, [](const Entry& a, const Entry& b) { return a.triangle < b.triangle; });
    std::vector<Triangle> result;
    std::transform(entries.begin(), end, std::back_inserter(result),
                   [&](const Entry& entry) { return triangles[entry.triangle]; });
    return result;
}

std::vector<Triangle> oriented_alike(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const auto neighbours = neighbours_across_edges(sorted_edges(positions, triangles), triangles.size());
    Sides sides(neighbours);
    std::vector<Triangle> result(triangles.begin(), triangles.end());
    for (uint32_t start = 0; start < triangles.size(); ++start) {
        if (sides.is_known(start)) {
            continue;
        }
        const Part part = sides.spread(start);
        double straight_area = 0; // less that of what lies the other way round
        for (const uint32_t t : part.triangles) {
            const auto& [a, b, c] = triangles[t];
            const double area =
                glm::length(glm::cross(positions[b] - positions[a], positions[c] - positions[a]));
            straight_area += sides.is_turned(t) ? -area : area;
        }
        for (const uint32_t t : part.triangles) {
            if (part.orientable && sides.is_turned(t) == (straight_area >= 0)) {
                std::swap(result[t][1], result[t][2]);
            }
        }
    }
    return result;
}

} // namespace anvil
