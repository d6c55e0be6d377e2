// `--device`: from its text to a back end.
#pragma once

#include "engine/core/log.h"
#include "engine/deform/backend.h"
#include "engine/gpu/device.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// A back end and, for Vulkan ones, its device.
struct ChosenBackend {
    std::unique_ptr<Backend> backend;
    std::shared_ptr<Device> device; ///< nullptr for `cpu`
};

/// What `auto` takes of these devices: a GPU's index, or nothing for the CPU back end, which is faster than
/// Vulkan on a CPU (lavapipe: 3 to 4 times, and it compiles no shaders first).
std::optional<size_t> automatic_device(const std::vector<DeviceInfo>& devices);

/// list_devices(), or none with a warning where there is no Vulkan.
std::vector<DeviceInfo> devices_or_none(Log& log);

/// `cpu`: the double-precision reference; anything else: a Vulkan device as choose_device() means it.
/// @throws DeviceError
ChosenBackend open_backend(const std::string& device);

/// open_backend(), but `auto` as above: without any Vulkan device it warns and computes
/// on the CPU. Anything else: a Vulkan device as choose_device() means it. @throws DeviceError
ChosenBackend choose_backend(const std::string& device, Log& log);

/// For the end of a command that used the device (nullptr: none).
/// @throws InternalError if the validation layer is on and objected to anything.
void check_validation(const std::shared_ptr<Device>& device);

} // namespace anvil
