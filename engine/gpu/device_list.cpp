#include "engine/gpu/device_state.h"
#include "engine/gpu/pinned_libraries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace anvil {

namespace {

constexpr const char* use_cpu = "`--device cpu` works without Vulkan";
constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

std::string version_text(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

DeviceType device_type(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return DeviceType::discrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return DeviceType::integrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
        return DeviceType::virtual_gpu;
    case vk::PhysicalDeviceType::eCpu:
        return DeviceType::cpu;
    default:
        return DeviceType::other;
    }
}

bool has_extension(const std::vector<vk::ExtensionProperties>& available, const char* name) {
    return std::any_of(available.begin(), available.end(),
                       [&](const auto& e) { return std::strcmp(e.extensionName.data(), name) == 0; });
}

std::vector<std::string> missing_features(const vk::raii::PhysicalDevice& physical, uint32_t api_version) {
    if (api_version < VK_API_VERSION_1_3) {
        return {"Vulkan 1.3 (it has " + version_text(api_version) + ")"};
    }
    std::vector<std::string> missing;
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                              vk::PhysicalDeviceVulkan13Features>();
    if (!features.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout) {
        missing.emplace_back("scalarBlockLayout");
    }
    if (!features.get<vk::PhysicalDeviceVulkan13Features>().synchronization2) {
        missing.emplace_back("synchronization2");
    }
    if (!features.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering) {
        missing.emplace_back("dynamicRendering");
    }
    if (!has_extension(physical.enumerateDeviceExtensionProperties(),
                       VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME)) {
        missing.emplace_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    }
    if (pick_queue_family(physical) == no_index) {
        missing.emplace_back("a compute queue");
    }
    return missing;
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string list_text(std::span<const DeviceInfo> devices) {
    std::string text = devices.empty() ? "there is none" : "there are:";
    for (const DeviceInfo& d : devices) {
        text += (d.index == 0 ? " " : ", ") + std::to_string(d.index) + " \"" + d.name + "\" (" +
                to_string(d.type) + ")";
    }
    return text;
}

std::string missing_text(const DeviceInfo& device) {
    std::string text = "device \"" + device.name + "\" lacks ";
    for (size_t i = 0; i < device.missing.size(); ++i) {
        text += (i > 0 ? ", " : "") + device.missing[i];
    }
    return text;
}

size_t usable_or_throw(std::span<const DeviceInfo> devices, size_t i) {
    if (!devices[i].usable()) {
        throw DeviceError(missing_text(devices[i]) + "; choose another device, or " + use_cpu);
    }
    return i;
}

size_t choose_automatically(std::span<const DeviceInfo> devices) {
    std::optional<size_t> best;
    for (size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].usable() && (!best || devices[i].type < devices[*best].type)) {
            best = i;
        }
    }
    if (best) {
        return *best;
    }
    if (devices.empty()) {
        throw DeviceError(std::string("there is no Vulkan device on this machine; ") + use_cpu);
    }
    throw DeviceError("no Vulkan device is usable: " + missing_text(devices[0]) + "; " + use_cpu);
}

void require_extensions(const std::vector<std::string>& wanted) {
    const auto available = vulkan_context().enumerateInstanceExtensionProperties();
    for (const std::string& name : wanted) {
        if (!has_extension(available, name.c_str())) {
            throw DeviceError("the Vulkan loader lacks the instance extension " + name);
        }
    }
}

void require_validation_layer() {
    const auto layers = vulkan_context().enumerateInstanceLayerProperties();
    const bool found = std::any_of(layers.begin(), layers.end(), [](const auto& layer) {
        return std::strcmp(layer.layerName.data(), validation_layer) == 0;
    });
    if (!found) {
        throw DeviceError(std::string("validation was asked for, but the layer ") + validation_layer +
                          " is not installed (Debian: vulkan-validationlayers)");
    }
}

} // namespace

std::string to_string(DeviceType type) {
    constexpr std::array names{"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};
    return names[static_cast<size_t>(type)];
}

vk::raii::Context& vulkan_context() {
    // Never closed: drivers leave threads and allocations behind that must not lose their code.
    static vk::raii::Context* context = nullptr;
    if (context == nullptr) {
        try {
            context = new vk::raii::Context();
        } catch (const std::runtime_error&) {
            throw DeviceError(
                std::string("there is no Vulkan loader on this machine (Debian: libvulkan1); ") + use_cpu);
        }
    }
    return *context;
}

uint32_t pick_queue_family(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    uint32_t compute_only = no_index;
    for (uint32_t i = 0; i < families.size(); ++i) {
        if (families[i].queueFlags & vk::QueueFlagBits::eCompute) {
            if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) {
                return i;
            }
            compute_only = std::min(compute_only, i);
        }
    }
    return compute_only;
}

vk::raii::Instance make_instance(const std::vector<std::string>& extensions, bool validation) {
    vk::raii::Context& context = vulkan_context();
    require_extensions(extensions);
    std::vector<const char*> names;
    names.reserve(extensions.size() + 1);
    for (const std::string& name : extensions) {
        names.push_back(name.c_str());
    }
    std::vector<const char*> layers;
    if (validation) {
        require_validation_layer();
        layers.push_back(validation_layer);
        names.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const std::array checks{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = checks.size(),
                                             .pEnabledValidationFeatures = checks.data()};
    const vk::ApplicationInfo application{.pApplicationName = "anvil", .apiVersion = VK_API_VERSION_1_3};
    const vk::InstanceCreateInfo info{.pNext = validation ? &features : nullptr,
                                      .pApplicationInfo = &application,
                                      .enabledLayerCount = static_cast<uint32_t>(layers.size()),
                                      .ppEnabledLayerNames = layers.data(),
                                      .enabledExtensionCount = static_cast<uint32_t>(names.size()),
                                      .ppEnabledExtensionNames = names.data()};
    try {
        vk::raii::Instance instance(context, info);
        pin_loaded_libraries();
        return instance;
    } catch (const vk::IncompatibleDriverError&) {
        throw DeviceError(
            std::string("there is no Vulkan driver on this machine (Debian: mesa-vulkan-drivers); ") +
            use_cpu);
    } catch (const vk::SystemError& error) {
        throw DeviceError(describe_failure("starting Vulkan", error));
    }
}

DeviceInfo describe_device(const vk::raii::PhysicalDevice& physical, uint32_t index) {
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    DeviceInfo info;
    info.index = index;
    info.name = properties.deviceName.data();
    info.type = device_type(properties.deviceType);
    info.api_version = version_text(properties.apiVersion);
    info.driver = version_text(properties.driverVersion);
    if (properties.apiVersion >= VK_API_VERSION_1_2) {
        const auto chain =
            physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
        const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
        info.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
    }
    const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            info.memory_bytes = std::max<uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);
        }
    }
    info.max_storage_binding = properties.limits.maxStorageBufferRange;
    info.max_texture_3d = properties.limits.maxImageDimension3D;
    const uint32_t family = pick_queue_family(physical);
    info.graphics =
        family != no_index && static_cast<bool>(physical.getQueueFamilyProperties()[family].queueFlags &
                                                vk::QueueFlagBits::eGraphics);
    info.missing = missing_features(physical, properties.apiVersion);
    return info;
}

std::vector<DeviceInfo> list_devices() {
    const vk::raii::Instance instance = make_instance({}, false);
    return guarded("listing the devices", [&] {
        std::vector<DeviceInfo> devices;
        for (const vk::raii::PhysicalDevice& physical : instance.enumeratePhysicalDevices()) {
            devices.push_back(describe_device(physical, static_cast<uint32_t>(devices.size())));
        }
        return devices;
    });
}

size_t choose_device(std::span<const DeviceInfo> devices, std::string_view choice) {
    if (choice.empty() || lower(choice) == "auto") {
        return choose_automatically(devices);
    }
    uint32_t index = 0;
    const char* end = choice.data() + choice.size();
    const auto [stop, fault] = std::from_chars(choice.data(), end, index);
    if (fault == std::errc() && stop == end && index < devices.size()) {
        return usable_or_throw(devices, index);
    }
    std::optional<size_t> unusable;
    for (size_t i = 0; i < devices.size(); ++i) {
        if (lower(devices[i].name).find(lower(choice)) != std::string::npos) {
            if (devices[i].usable()) {
                return i;
            }
            unusable = unusable.value_or(i);
        }
    }
    if (unusable) {
        return usable_or_throw(devices, *unusable);
    }
    throw DeviceError("no Vulkan device is called \"" + std::string(choice) + "\"; " + list_text(devices) +
                      "; " + use_cpu);
}

} // namespace anvil
