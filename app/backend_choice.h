// `--device`: from its text to a back end.
#pragma once

#include "engine/core/log.h"
#include "engine/deform/backend.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/mesh/lasting_search.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// `--bake`: auto, cpu or device.
DeviceBaking device_baking(const std::string& name);

/// @throws InputError where fields are to be baked on a device and there is none.
void check_baking(DeviceBaking baking, bool device);

/// A back end and, for Vulkan ones, its device.
struct ChosenBackend {
    std::unique_ptr<Backend> backend;
    std::shared_ptr<Device> device; ///< nullptr for `cpu`
};

/// What `auto` takes of these devices: a GPU's index, or nothing for the CPU back end, which on a CPU is to
/// be preferred to Vulkan: it computes in double, and compiles no kernels first (lavapipe: 0.3 to 1 s).
std::optional<size_t> automatic_device(const std::vector<DeviceInfo>& devices);

/// list_devices(), or none with a warning where there is no Vulkan.
std::vector<DeviceInfo> devices_or_none(Log& log);

/// `cpu`: the double-precision reference; anything else: a Vulkan device as choose_device() means it. `log`,
/// which outlives it, is told of meshes that are too large to be baked there. @throws DeviceError
ChosenBackend open_backend(const std::string& device, DeviceBaking baking = DeviceBaking::on_gpus,
                           Log* log = nullptr);

/// open_backend() of a Vulkan device, with the CPU back end to go on with where the device fails, now or
/// later: a warning says so.
ChosenBackend open_lasting(const std::string& device, Log& log, DeviceBaking baking = DeviceBaking::on_gpus);

/// open_backend(), but `auto` as above: without any Vulkan device it warns and computes
/// on the CPU, and a GPU that fails is followed by the CPU. Anything else: a Vulkan device as choose_device()
/// means it. @throws DeviceError
ChosenBackend choose_backend(const std::string& device, Log& log,
                             DeviceBaking baking = DeviceBaking::on_gpus);

/// What fields are baked with where nothing is deformed.
struct ChosenSearch {
    std::shared_ptr<Device> device; ///< nullptr: the CPU
    std::unique_ptr<SearchDevice> search;
    std::unique_ptr<LastingSearchDevice> lasting;

    SearchDevice* get() const { return lasting ? lasting.get() : search.get(); }
};

/// `cpu`: nothing; `auto`: a GPU if there is one, whose failure is a warning; anything else: a Vulkan device
/// as choose_device() means it. @throws DeviceError
ChosenSearch choose_search(const std::string& device, Log& log);

/// For the end of a command that used the device (nullptr: none).
/// @throws InternalError if the validation layer is on and objected to anything.
void check_validation(const std::shared_ptr<Device>& device);

} // namespace anvil
