#include "engine/gpu/deform_pipeline.h"

#include "engine/gpu/normals_pass.h"
#include "engine/occluder/kernel_types.h"

#include "embedded/deform.comp.h"
#include "embedded/deform_few.comp.h"
#include "embedded/deform_few_windows.comp.h"
#include "embedded/deform_wide.comp.h"
#include "embedded/deform_windows.comp.h"

#include <algorithm>
#include <array>
#include <bit>

namespace anvil {

namespace {

constexpr size_t few_occluders = 4;
constexpr size_t few_nodes = 8;
constexpr uint32_t most_kept_segments = 16; // unrolled in every place that blends: compiling takes longer
constexpr uint32_t points_on_cpu = 8;
constexpr uint32_t most_wide_handles = 8; // with more, two points at once run out of registers
constexpr uint32_t blended_on_cpu = 64;   // without occluders all points take alike

/// In the order of the shader's bindings.
std::vector<ResourceKind> deform_resources(bool windows) {
    std::vector<ResourceKind> kinds(9, ResourceKind::storage_buffer);
    kinds.insert(kinds.end(), kernel::f32::MAX_VOLUMES, ResourceKind::volume_texture);
    // Poses, words of adaptive fields, ends, counts.
    kinds.insert(kinds.end(), deform_resource_count - kinds.size(), ResourceKind::storage_buffer);
    kinds.insert(kinds.end(), windows ? field_windows : 0, ResourceKind::uniform_buffer);
    return kinds;
}

/// How many segments each of the shapes has, 0 if they have different numbers or there are none.
uint32_t segments_of_each(const std::vector<kernel::f64::CurveRange>& shapes) {
    const bool same = std::all_of(shapes.begin(), shapes.end(),
                                  [&](const auto& shape) { return shape.count == shapes[0].count; });
    return shapes.empty() || !same ? 0 : shapes[0].count;
}

void keep_handles(const DeformInput& input, DeformVariant& variant) {
    const uint32_t each = segments_of_each(input.shapes);
    const auto handles = static_cast<uint32_t>(input.handle_count);
    if (variant.one_sample != 0 && each > 0 && uint64_t{handles} * each <= most_kept_segments) {
        variant.kept_handles = handles;
        variant.segments_each = each;
    }
}

std::span<const uint32_t> shader_of(const DeformVariant& variant) {
    if (variant.wide) {
        return deform_wide_comp;
    }
    if (variant.windows) {
        return variant.few ? std::span<const uint32_t>(deform_few_windows_comp)
                           : std::span<const uint32_t>(deform_windows_comp);
    }
    return variant.few ? std::span<const uint32_t>(deform_few_comp) : std::span<const uint32_t>(deform_comp);
}

} // namespace

DeformVariant variant_of(const DeformInput& input, const DeformMotion& motion) {
    const OccluderSet& occluders = input.occluders;
    const kernel::f64::KernelParams params = kernel_params(input, motion);
    const auto volumes = static_cast<uint32_t>(occluders.volumes.size());
    DeformVariant variant;
    variant.occluders = occluders.empty() ? 0 : 1;
    variant.volumes = volumes == 0 ? 0 : std::bit_ceil(volumes);
    variant.paper = params.paper;
    variant.moving = params.moving;
    variant.motion = params.motion;
    variant.steps = params.steps;
    variant.writes_ends = input.fans.empty() ? 0 : 1;
    variant.one_sample = params.sample_count == 1 ? 1 : 0;
    keep_handles(input, variant);
    for (const kernel::f64::ShapeNode& node : occluders.nodes) {
        variant.shape_kinds |= 1U << node.kind;
    }
    variant.few = !occluders.empty() && occluders.occluders.size() <= few_occluders &&
                  occluders.nodes.size() <= few_nodes;
    if (variant.few) {
        variant.occluder_count = static_cast<uint32_t>(occluders.occluders.size());
        variant.node_count = static_cast<uint32_t>(occluders.nodes.size());
        for (uint32_t i = 0; i < variant.occluder_count; ++i) {
            variant.node_counts |= occluders.occluders[i].node_count << (4 * i);
            variant.influences |= occluders.occluders[i].influence << (4 * i);
        }
        for (uint32_t i = 0; i < variant.node_count; ++i) {
            variant.kinds |= occluders.nodes[i].kind << (4 * i);
        }
    }
    return variant;
}

DeformPipeline::DeformPipeline(std::shared_ptr<Device> device)
    : device_(std::move(device)), normals_kernel_(make_normals_kernel(device_->state())),
      no_volume_(device_->state(), {1, 1, 1}, std::array<float, 4>{}),
      no_words_(storage_buffer(device_->state(), std::span<const uint32_t>(std::array<uint32_t, 1>{}))) {}

size_t DeformPipeline::kernel_count() {
    const std::scoped_lock lock(mutex_);
    return kernels_.size();
}

DeformVariant DeformPipeline::fitted(DeformVariant variant) const {
    if (info().type == DeviceType::cpu) {
        variant.points_each = variant.occluders != 0 ? points_on_cpu : blended_on_cpu;
        variant.handles_each = variant.kept_handles > 0 ? field_blocks(variant.kept_handles).handles_each : 0;
        variant.windows = variant.handles_each > 0;
        variant.wide = variant.windows && variant.occluders == 0 && device().wide_integers &&
                       variant.kept_handles <= most_wide_handles;
    } else {
        variant.kept_handles = 0;
        variant.segments_each = 1;
    }
    return variant;
}

FieldBlocks DeformPipeline::field_blocks(size_t handle_count) const {
    if (info().type != DeviceType::cpu || handle_count == 0 || handle_count > most_kept_segments) {
        return {uint32_t{1} << 30, 0};
    }
    const auto each = static_cast<uint32_t>((handle_count + field_windows - 1) / field_windows);
    const auto numbers = static_cast<uint32_t>(field_window_bytes / sizeof(float));
    return {numbers / each / deform_workgroup * deform_workgroup, each};
}

const ComputeKernel& DeformPipeline::kernel(const DeformVariant& wanted) {
    const DeformVariant variant = fitted(wanted);
    const std::scoped_lock lock(mutex_); // whoever asks for what is being compiled waits for it
    for (const auto& [known, kernel] : kernels_) {
        if (known == variant) {
            return *kernel;
        }
    }
    const std::array<uint32_t, 18> constants{
        variant.occluders,     variant.volumes,     variant.paper,       variant.motion,
        variant.steps,         variant.one_sample,  variant.shape_kinds, variant.occluder_count,
        variant.node_count,    variant.node_counts, variant.kinds,       variant.influences,
        variant.moving,        variant.writes_ends, variant.points_each, variant.kept_handles,
        variant.segments_each, variant.handles_each};
    kernels_.emplace_back(variant, std::make_unique<ComputeKernel>(
                                       device_->state(), shader_of(variant),
                                       deform_resources(variant.windows), sizeof(kernel::f32::KernelParams),
                                       deform_workgroup * variant.points_each, constants));
    return *kernels_.back().second;
}

template <class Source, class Upload, class Make>
std::shared_ptr<const Upload> DeformPipeline::cached(Cache<Source, Upload>& cache,
                                                     const std::shared_ptr<const Source>& source,
                                                     const Make& make) {
    std::erase_if(cache, [](const auto& entry) { return entry.first.expired() || entry.second.expired(); });
    for (const auto& [known, upload] : cache) {
        if (std::shared_ptr<const Upload> found = upload.lock(); found && known.lock() == source) {
            return found;
        }
    }
    auto upload = std::make_shared<const Upload>(make());
    cache.emplace_back(source, upload);
    return upload;
}

std::shared_ptr<const VolumeTexture>
DeformPipeline::texture(const std::shared_ptr<const DistanceVolume>& volume) {
    return cached(textures_, volume,
                  [&] { return VolumeTexture(device_->state(), volume->size, volume->texels); });
}

std::shared_ptr<const Buffer>
DeformPipeline::field_words(const std::shared_ptr<const std::vector<uint32_t>>& words) {
    return cached(words_, words,
                  [&] { return storage_buffer(device_->state(), std::span<const uint32_t>(*words)); });
}

} // namespace anvil
