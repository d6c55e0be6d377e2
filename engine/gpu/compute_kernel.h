// One compute shader with its resources pushed at record time; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/volume_texture.h"

#include <span>
#include <type_traits>
#include <variant>
#include <vector>

namespace anvil {

/// Bytes [offset, offset + bytes) of a storage or uniform buffer.
struct BufferRange {
    const Buffer* buffer = nullptr;
    uint64_t offset = 0;
    uint64_t bytes = 0;

    explicit BufferRange(const Buffer& whole) : buffer(&whole), bytes(whole.size()) {}
    /// `first`: a multiple of 256, which every device's minStorageBufferOffsetAlignment divides.
    BufferRange(const Buffer& whole, uint64_t first, uint64_t size)
        : buffer(&whole), offset(first), bytes(size) {}
};

/// What a binding holds; binding i of the shader's set 0 is entry i of the list.
using Resource = std::variant<BufferRange, const VolumeTexture*>;
enum class ResourceKind { storage_buffer, volume_texture, uniform_buffer };

class ComputeKernel {
  public:
    /// `workgroup`: local_size_x of the shader; `constants`: values of its specialization constants 0, 1, ...
    /// @throws DeviceError if the device rejects the pipeline; InternalError if `parameter_bytes` exceeds
    /// 128, which is all that every device grants.
    ComputeKernel(DeviceState& device, std::span<const uint32_t> spirv, std::vector<ResourceKind> kinds,
                  uint32_t parameter_bytes, uint32_t workgroup, std::span<const uint32_t> constants = {});

    size_t resource_count() const { return kinds_.size(); }

    /// Dispatches at least `count` invocations, in one or two dimensions as the device's limits want it: the
    /// shader takes its index from shaders/shared/invocation.glsl and returns where it is >= count.
    /// count = 0 records nothing. A barrier between dependent dispatches is the caller's.
    template <class Parameters>
    void record(const vk::raii::CommandBuffer& commands, std::span<const Resource> resources,
                const Parameters& parameters, uint32_t count) const {
        static_assert(std::is_trivially_copyable_v<Parameters>);
        record_bytes(commands, resources, std::as_bytes(std::span(&parameters, 1)), count);
    }

  private:
    void record_bytes(const vk::raii::CommandBuffer& commands, std::span<const Resource> resources,
                      std::span<const std::byte> parameters, uint32_t count) const;
    void push_resources(const vk::raii::CommandBuffer& commands, std::span<const Resource> resources) const;

    std::vector<ResourceKind> kinds_;
    uint32_t parameter_bytes_;
    uint32_t workgroup_;
    std::array<uint32_t, 2> max_groups_{};
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::Pipeline pipeline_{nullptr};
};

} // namespace anvil
