// Where benchmarks run their edits.
#pragma once

#include "engine/core/error.h"
#include "engine/deform/backend.h"
#ifdef ANVIL_BENCH_DEVICE
#include "engine/gpu/gpu_backend.h"
#endif

namespace anvil::bench {

/// The CPU in double, or the Vulkan device that the program would take. @throws InputError where it is built
/// without; DeviceError.
inline std::unique_ptr<Backend> bench_backend(bool on_device) {
    if (!on_device) {
        return make_cpu_backend();
    }
#ifdef ANVIL_BENCH_DEVICE
    return make_gpu_backend(std::make_shared<Device>(DeviceOptions{}));
#else
    throw InputError("this benchmark is built without Vulkan; leave out --device");
#endif
}

} // namespace anvil::bench
