// What a session leaves on its device, to be drawn without a copy; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/deform/backend.h"
#include "engine/gpu/device_state.h"

#include <optional>

namespace anvil {

/// Storage buffers of three floats an entry, tightly packed; valid as long as the session. What the session
/// has submitted writes them: readers on the device's queue begin with a full_barrier().
struct DeviceSurface {
    vk::Buffer ends;    ///< places of the input's points, relative to its local origin; more follow
    vk::Buffer normals; ///< one for each run of the input's fans: of the points, then of those around them
    uint32_t point_count = 0;
    uint32_t normal_count = 0;
};

/// Nothing if the session computes elsewhere than on `device`, or its input has no fans.
std::optional<DeviceSurface> device_surface(const DeformSession& session, const Device& device);

} // namespace anvil
