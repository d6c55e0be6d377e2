// Memory of a device, counted as long as it is held; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/gpu/device_state.h"

#include <atomic>
#include <memory>

namespace anvil {

class HeldMemory {
  public:
    HeldMemory() = default; ///< none
    /// As many bytes of a memory type. Called in guarded().
    HeldMemory(DeviceState& device, uint64_t bytes, uint32_t type);
    HeldMemory(HeldMemory&& other) noexcept;
    HeldMemory& operator=(HeldMemory&& other) noexcept;
    ~HeldMemory();

    const vk::raii::DeviceMemory& memory() const { return memory_; }

  private:
    vk::raii::DeviceMemory memory_{nullptr};
    std::atomic<uint64_t>* in_use_ = nullptr; ///< the device's count
    uint64_t bytes_ = 0;
};

} // namespace anvil
