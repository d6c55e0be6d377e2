// `--device`: from its text to a back end.
#pragma once

#include "engine/deform/backend.h"
#include "engine/gpu/device.h"

#include <memory>
#include <string>

namespace anvil {

/// A back end and, for Vulkan ones, its device.
struct ChosenBackend {
    std::unique_ptr<Backend> backend;
    std::shared_ptr<Device> device; ///< nullptr for `cpu`
};

/// `cpu`: the double-precision reference. Anything else: a Vulkan device as choose_device() means it.
/// @throws DeviceError
ChosenBackend choose_backend(const std::string& device);

/// For the end of a command that used the device (nullptr: none).
/// @throws InternalError if the validation layer is on and objected to anything.
void check_validation(const std::shared_ptr<Device>& device);

} // namespace anvil
