// A Vulkan buffer with its memory; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/gpu/held_memory.h"

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace anvil {

/// Which memory a buffer wants; host-visible memory is mapped for good, other memory is reached by staging
/// copies.
enum class MemoryUse {
    device,   ///< the kernels' working data; device-local
    upload,   ///< written by the host every update: host-visible, device-local too where that exists
    download, ///< read by the host: host-visible and cached
};

class Buffer {
  public:
    Buffer() = default; ///< no bytes
    /// Uninitialized. @throws DeviceError if a storage buffer is larger than one binding may be, or memory is
    /// out.
    Buffer(DeviceState& device, uint64_t bytes, vk::BufferUsageFlags usage, MemoryUse use);

    uint64_t size() const { return bytes_; }
    vk::Buffer handle() const { return *buffer_; }

    /// Copies to or from the buffer; blocks, and waits for the queue where a staging copy is needed. The
    /// caller has waited for the work that uses the buffer. The range must lie inside (InternalError).
    void write(uint64_t offset, std::span<const std::byte> data);
    void read(uint64_t offset, std::span<std::byte> data) const;

    template <class T>
    void write_all(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        write(0, std::as_bytes(values));
    }

  private:
    void check_range(uint64_t offset, uint64_t bytes) const;

    DeviceState* device_ = nullptr;
    uint64_t bytes_ = 0;
    HeldMemory memory_; ///< outlives the buffer bound to it
    vk::raii::Buffer buffer_{nullptr};
    std::byte* mapped_ = nullptr;
    bool cached_ = false;
};

/// A storage buffer with these values (at least one element's bytes, so that it can be bound).
template <class T>
Buffer storage_buffer(DeviceState& device, std::span<const T> values, MemoryUse use = MemoryUse::device) {
    const uint64_t bytes = std::max(values.size_bytes(), sizeof(T));
    Buffer buffer(device, bytes, vk::BufferUsageFlagBits::eStorageBuffer, use);
    buffer.write_all(values);
    return buffer;
}

} // namespace anvil
