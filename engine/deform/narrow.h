// From the double structs to the float ones that cross to a device, in one place.
#pragma once

#include "engine/core/types.h"
#include "engine/occluder/kernel_types.h"

#include <span>
#include <vector>

namespace anvil {

kernel::f32::ShapeSegment narrowed(const kernel::f64::ShapeSegment& segment);
kernel::f32::CurveRange narrowed(const kernel::f64::CurveRange& range);
kernel::f32::ShapeNode narrowed(const kernel::f64::ShapeNode& node);
kernel::f32::Occluder narrowed(const kernel::f64::Occluder& occluder);
kernel::f32::Pose narrowed(const kernel::f64::Pose& pose);
kernel::f32::KernelParams narrowed(const kernel::f64::KernelParams& params);
glm::vec3 narrowed(const Vec3& v);
/// Infinities become +-1e30: kernels compute with them.
float narrowed(double x);

template <class T>
auto narrowed(std::span<const T> values) {
    std::vector<decltype(narrowed(values[0]))> result;
    result.reserve(values.size());
    for (const T& value : values) {
        result.push_back(narrowed(value));
    }
    return result;
}

} // namespace anvil
