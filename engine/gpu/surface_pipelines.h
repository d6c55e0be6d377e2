// The graphics pipelines of pictures; internal to engine/gpu.
#pragma once

#include "engine/gpu/graphics_pipeline.h"

#include <glm/glm.hpp>

namespace anvil {

namespace shader {
using glm::mat4;
#include "shaders/viewer/surface_parameters.h"
} // namespace shader

/// Vertices are SurfaceVertex, push constants shader::SurfaceParameters (vertex and fragment stage).
struct SurfacePipelines {
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline background{nullptr};
    vk::raii::Pipeline opaque{nullptr};
    vk::raii::Pipeline translucent_back{nullptr};  ///< back faces, blended, depth tested
    vk::raii::Pipeline translucent_front{nullptr}; ///< front faces likewise

    /// @throws DeviceError if the device rejects a pipeline.
    SurfacePipelines(DeviceState& device, const TargetFormat& target);
};

} // namespace anvil
