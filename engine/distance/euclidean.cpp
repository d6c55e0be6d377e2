#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/core/parallel_for.h"
#include "engine/distance/distance.h"
#include "engine/mesh/search_tree.h"

namespace anvil {
namespace {

/// glm::length overflows at 1e200 and vanishes at 1e-200.
double length_at_any_scale(const Vec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0)) {
        return 0;
    }
    const double unit = std::ldexp(1.0, std::clamp(std::ilogb(largest), -1000, 1000));
    return unit * glm::length(v * (1 / unit));
}

} // namespace

DistanceField euclidean_distances(std::span<const Vec3> positions, std::span<const Vec3> points,
                                  std::span<const std::array<Vec3, 3>> triangles, double radius) {
    if (!(radius >= 0)) {
        throw InputError("distances: the radius is " + number_text(radius) + "; give a number >= 0");
    }
    std::vector<Vec3> corners;
    std::vector<Triangle> indices;
    for (const std::array<Vec3, 3>& triangle : triangles) {
        const auto first = static_cast<uint32_t>(corners.size());
        corners.insert(corners.end(), triangle.begin(), triangle.end());
        indices.push_back({first, first + 1, first + 2});
    }
    const SearchTree tree(corners, indices);
    std::vector<double> distances(positions.size(), infinity);
    parallel_for(positions.size(), 1 << 12, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            for (const Vec3& point : points) {
                distances[v] = std::min(distances[v], length_at_any_scale(positions[v] - point));
            }
            distances[v] =
                std::min(distances[v], tree.closest(positions[v], std::min(distances[v], radius)).distance);
        }
    });
    DistanceField field;
    field.method = DistanceMethod::exact;
    const bool sources = !points.empty() || !triangles.empty();
    for (size_t v = 0; v < positions.size(); ++v) {
        if (distances[v] <= radius && sources) {
            field.vertices.push_back(static_cast<uint32_t>(v));
            field.distances.push_back(distances[v]);
        }
    }
    return field;
}

} // namespace anvil
