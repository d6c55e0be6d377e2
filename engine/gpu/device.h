// A Vulkan device: which ones there are, which one is taken, and what the rest of the GPU layer works with.
#pragma once

#include "engine/gpu/vulkan_handles.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anvil {

struct DeviceState; // engine/gpu/device_state.h: internal

enum class DeviceType { discrete, integrated, virtual_gpu, cpu, other };

/// "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
std::string to_string(DeviceType type);

struct DeviceInfo {
    uint32_t index = 0; ///< position in the driver's list: the INDEX of `--device INDEX`
    std::string name;
    DeviceType type = DeviceType::other;
    std::string driver;               ///< name and version
    std::string api_version;          ///< "1.3.230"
    uint64_t memory_bytes = 0;        ///< the largest device-local heap
    uint64_t max_storage_binding = 0; ///< bytes that one storage buffer binding may span
    uint32_t max_texture_3d = 0;      ///< voxels along a side of a 3D texture
    bool graphics = false;            ///< can render pictures
    std::vector<std::string> missing; ///< what Anvil needs and the device lacks; empty: usable

    bool usable() const { return missing.empty(); }
};

/// Every Vulkan device of this machine, in the driver's order; may be empty.
/// @throws DeviceError if there is no Vulkan loader or no driver.
std::vector<DeviceInfo> list_devices();

/// Which entry of `devices` a choice means: `auto` (a discrete GPU, then integrated, then virtual, then CPU
/// Vulkan; unusable ones never), an INDEX, or a NAME (case-insensitive part of the device's name; the first
/// usable match).
/// @throws DeviceError that lists the devices if nothing fits or the chosen one lacks something.
size_t choose_device(std::span<const DeviceInfo> devices, std::string_view choice);

struct DeviceOptions {
    std::string choice = "auto";
    /// Khronos validation layer with synchronization checks; also switched on by ANVIL_VALIDATION=1.
    bool validation = false;
    std::vector<std::string> instance_extensions = {}; ///< wanted beside ours, e.g. for a window's surface
    std::vector<std::string> device_extensions = {};   ///< likewise, e.g. VK_KHR_swapchain
};

/// Owned or borrowed. Several threads may work with it, each with objects of its own made from it, which must
/// go before it.
class Device {
  public:
    /// @throws DeviceError: no loader, driver or device, a feature or extension missing (named), or the
    /// validation layer asked for and not installed.
    explicit Device(const DeviceOptions& options = {});
    /// Uses a program's own handles, which outlive this object. @throws DeviceError
    explicit Device(const VulkanHandles& borrowed);
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;

    const DeviceInfo& info() const;
    VulkanHandles handles() const;
    uint64_t memory_in_use() const; ///< bytes of all buffers and volume textures made from it

    /// The validation layer's messages since the last call, each as one text; empty is the healthy state.
    std::vector<std::string> take_validation_messages();

    DeviceState& state() const { return *state_; } ///< for engine/gpu alone

  private:
    std::unique_ptr<DeviceState> state_;
};

} // namespace anvil
