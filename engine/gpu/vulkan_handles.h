// Vulkan handles of a program that brings its own, without Vulkan's headers: the same opaque types.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct VkInstance_T;
struct VkPhysicalDevice_T;
struct VkDevice_T;
struct VkQueue_T;

namespace anvil {

/// A logical device and one queue of it. The queue's family supports compute; the offscreen renderer also
/// wants graphics. The device was created for Vulkan 1.3 with scalarBlockLayout, synchronization2,
/// dynamicRendering and VK_KHR_push_descriptor. Whoever made the handles destroys them, after the last use.
struct VulkanHandles {
    VkInstance_T* instance = nullptr;
    VkPhysicalDevice_T* physical_device = nullptr;
    VkDevice_T* device = nullptr;
    VkQueue_T* queue = nullptr;
    uint32_t queue_family = 0;
};

} // namespace anvil
