// Nearest triangles by a compute kernel: what bakes distance fields on a GPU.
#pragma once

#include "engine/core/log.h"
#include "engine/gpu/device.h"
#include "engine/mesh/triangle_search.h"

#include <memory>

namespace anvil {

struct SearchDeviceOptions {
    /// Points searched at once have buffers of at most this (and what the device binds).
    uint64_t chunk_bytes = uint64_t{16} << 20;
    /// Trees whose triangles take more (60 bytes each; or more than the device binds) are not put there.
    uint64_t tree_bytes = uint64_t{1} << 32;
    /// Is told of such trees, where somebody asked for them to be here; outlives the device.
    Log* log = nullptr;
};

/// Keeps the device alive. find() throws InternalError if the kernel wrote behind its results.
/// @throws DeviceError if the device rejects the kernel.
std::unique_ptr<SearchDevice> make_search_device(std::shared_ptr<Device> device,
                                                 const SearchDeviceOptions& options = {});

} // namespace anvil
