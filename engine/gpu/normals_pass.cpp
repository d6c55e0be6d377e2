#include "engine/gpu/normals_pass.h"

#include "engine/occluder/kernel_types.h"

#include "embedded/normals.comp.h"

#include <algorithm>

namespace anvil {

static_assert(sizeof(kernel::f64::FanCorner) == 8); // as the shader has it

ComputeKernel make_normals_kernel(DeviceState& device) {
    return {device, normals_comp, std::vector<ResourceKind>(4, ResourceKind::storage_buffer),
            2 * sizeof(uint32_t), normals_workgroup};
}

NormalsPass::NormalsPass(DeviceState& device, const ComputeKernel& kernel, const NormalFans& fans,
                         const Buffer& ends, uint64_t chunk_bytes)
    : kernel_(kernel), count_(fans.normal_count()),
      normals_(device, std::max<uint64_t>(count_, 1) * sizeof(glm::vec3),
               vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device) {
    const uint64_t bytes = std::min<uint64_t>(chunk_bytes, device.limits.maxStorageBufferRange);
    const uint64_t most = std::max<uint64_t>(bytes / sizeof(kernel::f64::FanCorner), 1);
    for (size_t first = 0; first < count_;) {
        const uint32_t start = fans.begin[first];
        // At least one vertex, else as many as their corners have room for.
        const auto beyond = std::upper_bound(fans.begin.begin() + static_cast<std::ptrdiff_t>(first) + 2,
                                             fans.begin.end(), start + most);
        const auto last = static_cast<size_t>(beyond - fans.begin.begin()) - 1;
        Chunk chunk;
        chunk.parameters = {static_cast<uint32_t>(last - first), static_cast<uint32_t>(first)};
        std::vector<uint32_t> begin;
        for (size_t i = first; i <= last; ++i) {
            begin.push_back(fans.begin[i] - start);
        }
        chunk.begin = storage_buffer(device, std::span<const uint32_t>(begin));
        chunk.corners =
            storage_buffer(device, std::span(fans.corners).subspan(start, fans.begin[last] - start));
        chunks_.push_back(std::move(chunk));
        first = last;
    }
    for (Chunk& chunk : chunks_) {
        chunk.resources = {BufferRange(ends), BufferRange(chunk.begin), BufferRange(chunk.corners),
                           BufferRange(normals_)};
    }
}

void NormalsPass::record(const vk::raii::CommandBuffer& commands) const {
    for (const Chunk& chunk : chunks_) {
        kernel_.record(commands, chunk.resources, chunk.parameters, chunk.parameters.count);
    }
}

std::vector<Vec3> NormalsPass::download() const {
    std::vector<glm::vec3> raw(count_);
    if (!raw.empty()) {
        normals_.read(0, std::as_writable_bytes(std::span(raw)));
    }
    return {raw.begin(), raw.end()};
}

} // namespace anvil
