// The Vulkan back end: the sessions of engine/deform/backend.h on a device.
#pragma once

#include "engine/core/log.h"
#include "engine/deform/backend.h"
#include "engine/gpu/device.h"

#include <cstdint>
#include <memory>

namespace anvil {

/// Where a device bakes distance fields: on GPUs, which do it faster than the CPU; on CPUs, lavapipe's, it is
/// the other way round.
enum class DeviceBaking { on_gpus, always, never };

struct GpuBackendOptions {
    /// Points are worked in chunks whose buffers take at most this (and what the device binds at once).
    uint64_t chunk_bytes = uint64_t{128} << 20;
    DeviceBaking baking = DeviceBaking::on_gpus;
    /// Is told of meshes that are too large to be baked here, where that was asked for; outlives the back
    /// end.
    Log* log = nullptr;
};

/// Sessions upload once (float, relative to the input's local origin), submit one command buffer an update,
/// and allocate nothing in an update whose path has no more samples than an earlier one's, nor for shapes and
/// occluders that are no more than before. They keep the device alive. download() throws InternalError if the
/// kernel wrote behind its results. @throws DeviceError if the device rejects the kernel.
std::unique_ptr<Backend> make_gpu_backend(std::shared_ptr<Device> device,
                                          const GpuBackendOptions& options = {});

} // namespace anvil
