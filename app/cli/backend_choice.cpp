#include "app/cli/backend_choice.h"

#include "engine/core/error.h"
#include "engine/gpu/gpu_backend.h"

namespace anvil {

ChosenBackend choose_backend(const std::string& device) {
    if (device == "cpu") {
        return {make_cpu_backend(), nullptr};
    }
    DeviceOptions options;
    options.choice = device;
    auto opened = std::make_shared<Device>(options);
    auto backend = make_gpu_backend(opened);
    return {std::move(backend), std::move(opened)};
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
