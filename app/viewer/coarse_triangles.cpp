#include "app/viewer/coarse_triangles.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace anvil {

namespace {

constexpr double most_cells = 1 << 20; ///< along an axis: three numbers fit 64 bits

struct Cluster {
    Vec3 sum{0};
    uint32_t count = 0;
    uint32_t nearest = no_index;
    double distance = infinity; ///< squared, of `nearest` from the mean
};

bool usable(const Triangle& t, std::span<const Vec3> positions) {
    return is_finite(positions[t[0]]) && is_finite(positions[t[1]]) && is_finite(positions[t[2]]);
}

/// Each vertex's cluster; no_index where no triangle uses it.
class Clusters {
  public:
    Clusters(std::span<const Vec3> positions, std::span<const Triangle> triangles, size_t count)
        : of_vertex_(positions.size(), no_index) {
        Box box;
        double area = 0;
        for (const Triangle& t : triangles) {
            if (usable(t, positions)) {
                const Vec3& a = positions[t[0]];
                area += 0.5 * glm::length(glm::cross(positions[t[1]] - a, positions[t[2]] - a));
                for (const uint32_t v : t) {
                    box.include(positions[v]);
                }
            }
        }
        // A sheet through a grid fills one cube for each square of it, and a square is two triangles.
        const double wanted = std::sqrt(2 * area / static_cast<double>(std::max<size_t>(count, 1)));
        const double cell = std::max({wanted, box.empty() ? 1.0 : box.diagonal() / most_cells, 1e-300});
        for (const Triangle& t : triangles) {
            if (usable(t, positions)) {
                for (const uint32_t v : t) {
                    add(v, positions[v], (positions[v] - box.low) / cell);
                }
            }
        }
        for (uint32_t v = 0; v < positions.size(); ++v) {
            offer(v, positions);
        }
    }

    uint32_t representative(uint32_t vertex) const { return clusters_[of_vertex_[vertex]].nearest; }

  private:
    void add(uint32_t v, const Vec3& place, const Vec3& in_cells) {
        if (of_vertex_[v] != no_index) {
            return;
        }
        uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            key = key << 21U | static_cast<uint64_t>(std::clamp(in_cells[axis], 0.0, most_cells));
        }
        const auto [found, is_new] = numbers_.try_emplace(key, static_cast<uint32_t>(clusters_.size()));
        if (is_new) {
            clusters_.emplace_back();
        }
        of_vertex_[v] = found->second;
        Cluster& cluster = clusters_[found->second];
        cluster.sum += place;
        ++cluster.count;
    }

    void offer(uint32_t v, std::span<const Vec3> positions) {
        if (of_vertex_[v] == no_index) {
            return;
        }
        Cluster& cluster = clusters_[of_vertex_[v]];
        const Vec3 off = positions[v] - cluster.sum / static_cast<double>(cluster.count);
        const double distance = glm::dot(off, off);
        if (distance < cluster.distance) {
            cluster.distance = distance;
            cluster.nearest = v;
        }
    }

    std::vector<uint32_t> of_vertex_;
    std::unordered_map<uint64_t, uint32_t> numbers_;
    std::vector<Cluster> clusters_;
};

} // namespace

std::vector<uint32_t> coarse_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                       size_t count) {
    const Clusters clusters(positions, triangles, count);
    std::vector<Triangle> coarse;
    for (const Triangle& t : triangles) {
        if (!usable(t, positions)) {
            continue;
        }
        Triangle corners{clusters.representative(t[0]), clusters.representative(t[1]),
                         clusters.representative(t[2])};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            coarse.push_back(corners);
        }
    }
    std::sort(coarse.begin(), coarse.end());
    coarse.erase(std::unique(coarse.begin(), coarse.end()), coarse.end());
    std::vector<uint32_t> indices;
    indices.reserve(3 * coarse.size());
    for (const Triangle& t : coarse) {
        indices.insert(indices.end(), t.begin(), t.end());
    }
    return indices;
}

} // namespace anvil
