// The shared kernel in float over many points, compiled for several processors.
#pragma once

#include "engine/deform/deform_input.h"

#include <span>

namespace anvil {

/// What the kernel reads and writes, as a device has it; the arrays outlive it.
struct FloatArrays {
    kernel::f32::KernelParams params{};
    std::span<const glm::vec3> points;
    std::span<const float> fields;
    std::span<const float> start_distances;
    std::span<const kernel::f32::ShapeSegment> segments;
    std::span<const kernel::f32::CurveRange> shapes;
    std::span<const kernel::f32::Occluder> occluders;
    std::span<const kernel::f32::ShapeNode> nodes;
    std::span<const glm::vec3> targets;
    std::span<const kernel::f32::Pose> poses;
    std::span<const std::shared_ptr<const DistanceVolume>> volumes;
    const uint32_t* field_words = nullptr;
    std::span<kernel::f32::VertexResult> results;
};

/// Results of points [begin, end).
using FloatLoop = void (*)(const FloatArrays& arrays, size_t begin, size_t end);

/// For any processor that this program is built for.
void plain_float_loop(const FloatArrays& arrays, size_t begin, size_t end);

/// For one with AVX2 and FMA; elsewhere and in builds that are not optimized the same as the plain one.
void avx2_float_loop(const FloatArrays& arrays, size_t begin, size_t end);

/// Whether avx2_float_loop is another one, and this processor can run it.
bool has_avx2_float_loop();

} // namespace anvil
