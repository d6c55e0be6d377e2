#include "engine/gpu/held_memory.h"

#include <utility>

namespace anvil {

HeldMemory::HeldMemory(DeviceState& device, uint64_t bytes, uint32_t type)
    : memory_(device.device.allocateMemory({.allocationSize = bytes, .memoryTypeIndex = type})),
      in_use_(&device.memory_in_use), bytes_(bytes) {
    *in_use_ += bytes_;
    ++device.allocations;
}

HeldMemory::HeldMemory(HeldMemory&& other) noexcept
    : memory_(std::move(other.memory_)), in_use_(std::exchange(other.in_use_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)) {}

HeldMemory& HeldMemory::operator=(HeldMemory&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(in_use_, other.in_use_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

HeldMemory::~HeldMemory() {
    if (in_use_ != nullptr) {
        *in_use_ -= bytes_;
    }
}

} // namespace anvil
