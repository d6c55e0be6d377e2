#include "engine/gpu/buffer.h"

#include <algorithm>
#include <cstring>

namespace anvil {

namespace {

constexpr uint64_t staging_bytes = 16U << 20; // per copy: large enough for full speed, small beside the data

using Memory = vk::MemoryPropertyFlagBits;

vk::MemoryPropertyFlags required_flags(MemoryUse use) {
    return use == MemoryUse::device ? vk::MemoryPropertyFlags{}
                                    : Memory::eHostVisible | Memory::eHostCoherent;
}

vk::MemoryPropertyFlags preferred_flags(MemoryUse use) {
    switch (use) {
    case MemoryUse::download:
        return Memory::eHostVisible | Memory::eHostCoherent | Memory::eHostCached;
    case MemoryUse::upload:
        return Memory::eHostVisible | Memory::eHostCoherent | Memory::eDeviceLocal;
    default:
        return Memory::eDeviceLocal;
    }
}

std::string mebibytes(uint64_t bytes) {
    return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB";
}

void copy(DeviceState& device, vk::Buffer from, uint64_t from_offset, vk::Buffer to, uint64_t to_offset,
          uint64_t bytes) {
    run_commands(device, [&](const vk::raii::CommandBuffer& commands) {
        full_barrier(commands);
        commands.copyBuffer(from, to, vk::BufferCopy{from_offset, to_offset, bytes});
        full_barrier(commands);
    });
}

} // namespace

Buffer::Buffer(DeviceState& device, uint64_t bytes, vk::BufferUsageFlags usage, MemoryUse use)
    : device_(&device), bytes_(bytes) {
    if ((usage & vk::BufferUsageFlagBits::eStorageBuffer) && bytes > device.limits.maxStorageBufferRange) {
        throw DeviceError("a buffer of " + mebibytes(bytes) + " is wanted, device \"" + device.info.name +
                          "\" binds at most " + mebibytes(device.limits.maxStorageBufferRange));
    }
    guarded("taking device memory", [&] {
        buffer_ = device.device.createBuffer(
            {.size = std::max<uint64_t>(bytes, 4),
             .usage = usage | vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst});
        const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
        const uint32_t type =
            device.memory_type(needs.memoryTypeBits, required_flags(use), preferred_flags(use));
        memory_ = HeldMemory(device, needs.size, type);
        buffer_.bindMemory(*memory_.memory(), 0);
        const vk::MemoryPropertyFlags flags = device.memory.memoryTypes[type].propertyFlags;
        if ((flags & Memory::eHostVisible) && (flags & Memory::eHostCoherent)) {
            mapped_ = static_cast<std::byte*>(memory_.memory().mapMemory(0, VK_WHOLE_SIZE));
            cached_ = static_cast<bool>(flags & Memory::eHostCached);
        }
    });
}

void Buffer::check_range(uint64_t offset, uint64_t bytes) const {
    if (offset > bytes_ || bytes > bytes_ - offset) {
        throw InternalError("a copy leaves its buffer");
    }
}

void Buffer::write(uint64_t offset, std::span<const std::byte> data) {
    check_range(offset, data.size());
    if (data.empty()) {
        return;
    }
    device_->bytes_written += data.size();
    if (mapped_ != nullptr) {
        std::memcpy(mapped_ + offset, data.data(), data.size());
        return;
    }
    Buffer staging(*device_, std::min<uint64_t>(data.size(), staging_bytes), {}, MemoryUse::upload);
    for (uint64_t done = 0; done < data.size(); done += staging_bytes) {
        const uint64_t piece = std::min<uint64_t>(staging_bytes, data.size() - done);
        std::memcpy(staging.mapped_, data.data() + done, piece);
        copy(*device_, staging.handle(), 0, handle(), offset + done, piece);
    }
}

void Buffer::read(uint64_t offset, std::span<std::byte> data) const {
    check_range(offset, data.size());
    if (data.empty()) {
        return;
    }
    // Reading uncached memory costs more than a copy to cached memory.
    if (mapped_ != nullptr && cached_) {
        std::memcpy(data.data(), mapped_ + offset, data.size());
        return;
    }
    Buffer staging(*device_, std::min<uint64_t>(data.size(), staging_bytes), {}, MemoryUse::download);
    for (uint64_t done = 0; done < data.size(); done += staging_bytes) {
        const uint64_t piece = std::min<uint64_t>(staging_bytes, data.size() - done);
        copy(*device_, handle(), offset + done, staging.handle(), 0, piece);
        std::memcpy(data.data() + done, staging.mapped_, piece);
    }
}

} // namespace anvil
