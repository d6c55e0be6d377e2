#include "app/backend_choice.h"

#include "engine/core/error.h"
#include "engine/deform/lasting_backend.h"
#include "engine/gpu/search_device.h"

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

DeviceBaking device_baking(const std::string& name) {
    if (name == "device") {
        return DeviceBaking::always;
    }
    return name == "cpu" ? DeviceBaking::never : DeviceBaking::on_gpus;
}

void check_baking(DeviceBaking baking, bool device) {
    if (baking == DeviceBaking::always && !device) {
        throw InputError("--bake device: the edits are computed without a Vulkan device here; name one by "
                         "--device (see anvil devices)");
    }
}

ChosenBackend open_backend(const std::string& device, DeviceBaking baking, Log* log) {
    if (device == "cpu") {
        return {make_cpu_backend(), nullptr};
    }
    DeviceOptions options;
    options.choice = device;
    auto opened = std::make_shared<Device>(options);
    auto backend = make_gpu_backend(opened, {.baking = baking, .log = log});
    return {std::move(backend), std::move(opened)};
}

ChosenBackend open_lasting(const std::string& device, Log& log, DeviceBaking baking) {
    try {
        ChosenBackend opened = open_backend(device, baking, baking == DeviceBaking::always ? &log : nullptr);
        opened.backend = std::make_unique<LastingBackend>(std::move(opened.backend), log);
        return opened;
    } catch (const DeviceError& error) {
        log.warn(std::string(error.what()) + "; the CPU is used");
        return open_backend("cpu");
    }
}

ChosenBackend choose_backend(const std::string& device, Log& log, DeviceBaking baking) {
    if (device != "auto") {
        return open_backend(device, baking, &log);
    }
    const std::optional<size_t> chosen = automatic_device(devices_or_none(log));
    if (!chosen) {
        return open_backend("cpu");
    }
    return open_lasting(std::to_string(*chosen), log, baking);
}

ChosenSearch choose_search(const std::string& device, Log& log) {
    if (device == "cpu") {
        return {};
    }
    const auto open = [](const std::string& choice, Log* told) {
        ChosenSearch chosen;
        chosen.device = std::make_shared<Device>(DeviceOptions{.choice = choice});
        chosen.search = make_search_device(chosen.device, {.log = told});
        return chosen;
    };
    if (device != "auto") {
        return open(device, &log);
    }
    const std::optional<size_t> gpu = automatic_device(devices_or_none(log));
    if (!gpu) {
        return {};
    }
    try {
        ChosenSearch chosen = open(std::to_string(*gpu), nullptr);
        chosen.lasting = std::make_unique<LastingSearchDevice>(*chosen.search, log);
        return chosen;
    } catch (const DeviceError& error) {
        log.warn(std::string(error.what()) + "; the CPU is used");
        return {};
    }
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
