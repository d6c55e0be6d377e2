#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/distance/distance.h"

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

DistanceField euclidean_distances(std::span<const Vec3> positions, std::span<const Vec3> sources,
                                  double radius) {
    if (!(radius >= 0)) {
        throw InputError("distances: the radius is " + number_text(radius) + "; give a number >= 0");
    }
    DistanceField field;
    field.method = DistanceMethod::exact;
    for (size_t v = 0; v < positions.size(); ++v) {
        double nearest = infinity;
        for (const Vec3& source : sources) {
            nearest = std::min(nearest, length_at_any_scale(positions[v] - source));
        }
        if (nearest <= radius && !sources.empty()) {
            field.vertices.push_back(static_cast<uint32_t>(v));
            field.distances.push_back(nearest);
        }
    }
    return field;
}

} // namespace anvil
