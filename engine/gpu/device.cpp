#include "engine/gpu/device_state.h"
#include "engine/gpu/pinned_libraries.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace anvil {

namespace {

bool validation_wanted(const DeviceOptions& options) {
    const char* value = std::getenv("ANVIL_VALIDATION");
    return options.validation || (value != nullptr && *value != '\0' && std::strcmp(value, "0") != 0);
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                               VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto* messages = static_cast<ValidationMessages*>(user);
    const std::lock_guard lock(messages->mutex);
    messages->texts.emplace_back(data->pMessage);
    return VK_FALSE;
}

void listen_to_validation(DeviceState& state) {
    const vk::DebugUtilsMessengerCreateInfoEXT info{
        .messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning |
                           vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
        .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation |
                       vk::DebugUtilsMessageTypeFlagBitsEXT::ePerformance,
        .pfnUserCallback = collect_message,
        .pUserData = state.messages.get()};
    state.messenger = state.instance.createDebugUtilsMessengerEXT(info);
}

void require_device_extensions(const DeviceState& state, const std::vector<std::string>& wanted) {
    const auto available = state.physical.enumerateDeviceExtensionProperties();
    for (const std::string& name : wanted) {
        const bool found = std::any_of(available.begin(), available.end(), [&](const auto& extension) {
            return name == extension.extensionName.data();
        });
        if (!found) {
            throw DeviceError("device \"" + state.info.name + "\" lacks the extension " + name);
        }
    }
}

vk::raii::Device make_device(const DeviceState& state, const std::vector<std::string>& extensions) {
    std::vector<const char*> names{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    for (const std::string& name : extensions) {
        names.push_back(name.c_str());
    }
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{
        .queueFamilyIndex = state.queue_family, .queueCount = 1, .pQueuePriorities = &priority};
    const vk::PhysicalDeviceFeatures features{.shaderInt64 = state.wide_integers ? VK_TRUE : VK_FALSE};
    const vk::StructureChain chain{
        vk::DeviceCreateInfo{.queueCreateInfoCount = 1,
                             .pQueueCreateInfos = &queue,
                             .enabledExtensionCount = static_cast<uint32_t>(names.size()),
                             .ppEnabledExtensionNames = names.data(),
                             .pEnabledFeatures = &features},
        vk::PhysicalDeviceVulkan12Features{.scalarBlockLayout = VK_TRUE},
        vk::PhysicalDeviceVulkan13Features{.synchronization2 = VK_TRUE, .dynamicRendering = VK_TRUE}};
    return {state.physical, chain.get<vk::DeviceCreateInfo>()};
}

void finish(DeviceState& state) {
    state.limits = state.physical.getProperties().limits;
    state.memory = state.physical.getMemoryProperties();
}

std::vector<DeviceInfo> describe_all(const vk::raii::PhysicalDevices& physical) {
    std::vector<DeviceInfo> infos;
    for (const vk::raii::PhysicalDevice& device : physical) {
        infos.push_back(describe_device(device, static_cast<uint32_t>(infos.size())));
    }
    return infos;
}

} // namespace

Device::Device(const DeviceOptions& options) : state_(std::make_unique<DeviceState>()) {
    const bool validation = validation_wanted(options);
    state_->instance = make_instance(options.instance_extensions, validation);
    guarded("opening the device", [&] {
        if (validation) {
            state_->messages = std::make_unique<ValidationMessages>();
            listen_to_validation(*state_);
        }
        vk::raii::PhysicalDevices physical(state_->instance);
        const std::vector<DeviceInfo> infos = describe_all(physical);
        const size_t chosen = choose_device(infos, options.choice);
        state_->info = infos[chosen];
        state_->physical = std::move(physical[chosen]);
        state_->queue_family = pick_queue_family(state_->physical);
        require_device_extensions(*state_, options.device_extensions);
        state_->wide_integers = state_->physical.getFeatures().shaderInt64 == VK_TRUE;
        state_->device = make_device(*state_, options.device_extensions);
        state_->queue = state_->device.getQueue(state_->queue_family, 0);
        finish(*state_);
    });
    pin_loaded_libraries();
}

Device::Device(const VulkanHandles& borrowed) : state_(std::make_unique<DeviceState>()) {
    guarded("using the program's own Vulkan device", [&] {
        state_->borrowed = true;
        state_->instance = vk::raii::Instance(vulkan_context(), borrowed.instance);
        state_->physical = vk::raii::PhysicalDevice(state_->instance, borrowed.physical_device);
        state_->device = vk::raii::Device(state_->physical, borrowed.device);
        state_->queue = vk::raii::Queue(state_->device, borrowed.queue);
        state_->queue_family = borrowed.queue_family;
        state_->info = describe_device(state_->physical, 0);
        finish(*state_);
    });
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const {
    return state_->info;
}

uint64_t Device::memory_in_use() const {
    return state_->memory_in_use;
}

VulkanHandles Device::handles() const {
    return {*state_->instance, *state_->physical, *state_->device, *state_->queue, state_->queue_family};
}

std::vector<std::string> Device::take_validation_messages() {
    if (!state_->messages) {
        return {};
    }
    const std::lock_guard lock(state_->messages->mutex);
    return std::exchange(state_->messages->texts, {});
}

} // namespace anvil
