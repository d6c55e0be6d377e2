// The one place that includes Vulkan's C++ headers; internal to engine/gpu and app/viewer.
// Not precompiled: measured, the header costs 3.6 s a file, its precompiled form 10.6 s, 244 MB and ccache's
// help.
#pragma once

// The loader is opened at run time, so that a machine without one gets a readable error and the CPU back end.
#define VK_NO_PROTOTYPES
#define VULKAN_HPP_DISPATCH_LOADER_DYNAMIC 1
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>
