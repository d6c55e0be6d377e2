#include "engine/gpu/deform_pipeline.h"

#include "engine/occluder/kernel_types.h"

#include "embedded/deform.comp.h"

#include <algorithm>
#include <array>

namespace anvil {

namespace {

/// In the order of the shader's bindings.
std::vector<ResourceKind> deform_resources() {
    std::vector<ResourceKind> kinds(9, ResourceKind::storage_buffer);
    kinds.insert(kinds.end(), kernel::f32::MAX_VOLUMES, ResourceKind::volume_texture);
    return kinds;
}

} // namespace

DeformPipeline::DeformPipeline(std::shared_ptr<Device> device)
    : device_(std::move(device)), kernel_(device_->state(), deform_comp, deform_resources(),
                                          sizeof(kernel::f32::KernelParams), deform_workgroup),
      no_volume_(device_->state(), {1, 1, 1}, std::array<float, 4>{}) {}

std::shared_ptr<const VolumeTexture>
DeformPipeline::texture(const std::shared_ptr<const DistanceVolume>& volume) {
    std::erase_if(textures_,
                  [](const CachedTexture& entry) { return entry.first.expired() || entry.second.expired(); });
    for (const auto& [field, cached] : textures_) {
        if (std::shared_ptr<const VolumeTexture> texture = cached.lock(); texture && field.lock() == volume) {
            return texture;
        }
    }
    auto texture = std::make_shared<const VolumeTexture>(device_->state(), volume->size, volume->texels);
    textures_.emplace_back(volume, texture);
    return texture;
}

} // namespace anvil
