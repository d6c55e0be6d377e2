#include "engine/deform/fan_normals.h"

#include "engine/core/parallel_for.h"
#include "engine/deform/normal_kernel.h"

namespace anvil {

void find_fan_normals(const DeformInput& input, std::span<const PointResult> results, std::vector<Vec3>& ends,
                      std::vector<Vec3>& normals) {
    const NormalFans& fans = input.fans;
    if (fans.empty()) {
        return;
    }
    ends.resize(results.size());
    for (size_t i = 0; i < results.size(); ++i) {
        ends[i] = input.points[i] + results[i].displacement;
    }
    ends.insert(ends.end(), fans.rim.begin(), fans.rim.end());
    normals.resize(fans.normal_count());
    parallel_for(normals.size(), 1024, [&](size_t begin, size_t end) {
        kernel::f64::NormalKernel kernel{ends.data(), fans.begin.data(), fans.corners.data()};
        for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
            normals[i] = kernel.fan_normal(i, i);
        }
    });
}

} // namespace anvil
