#include "app/backend_choice.h"

#include "engine/core/error.h"
#include "engine/deform/lasting_backend.h"
#include "engine/gpu/gpu_backend.h"

#include <algorithm>

namespace anvil {

std::optional<size_t> automatic_device(const std::vector<DeviceInfo>& devices) {
    const bool any_usable =
        std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& d) { return d.usable(); });
    if (!any_usable) {
        return std::nullopt;
    }
    const size_t chosen = choose_device(devices, "auto");
    return devices[chosen].type == DeviceType::cpu ? std::nullopt : std::optional(chosen);
}

std::vector<DeviceInfo> devices_or_none(Log& log) {
    try {
        return list_devices();
    } catch (const DeviceError& error) {
        log.warn(error.what());
        return {};
    }
}

ChosenBackend open_backend(const std::string& device) {
    if (device == "cpu") {
        return {make_cpu_backend(), nullptr};
    }
    DeviceOptions options;
    options.choice = device;
    auto opened = std::make_shared<Device>(options);
    auto backend = make_gpu_backend(opened);
    return {std::move(backend), std::move(opened)};
}

ChosenBackend open_lasting(const std::string& device, Log& log) {
    try {
        ChosenBackend opened = open_backend(device);
        opened.backend = std::make_unique<LastingBackend>(std::move(opened.backend), log);
        return opened;
    } catch (const DeviceError& error) {
        log.warn(std::string(error.what()) + "; the CPU is used");
        return open_backend("cpu");
    }
}

ChosenBackend choose_backend(const std::string& device, Log& log) {
    if (device != "auto") {
        return open_backend(device);
    }
    const std::optional<size_t> chosen = automatic_device(devices_or_none(log));
    if (!chosen) {
        return open_backend("cpu");
    }
    return open_lasting(std::to_string(*chosen), log);
}

void check_validation(const std::shared_ptr<Device>& device) {
    if (!device) {
        return;
    }
    const std::vector<std::string> messages = device->take_validation_messages();
    if (!messages.empty()) {
        throw InternalError("the Vulkan validation layer objects: " + messages.front());
    }
}

} // namespace anvil
