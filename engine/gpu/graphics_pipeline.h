// One way to draw; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/gpu/device_state.h"

#include <cstdint>
#include <span>

namespace anvil {

/// What pipelines draw to; no depth: eUndefined.
struct TargetFormat {
    vk::Format colour;
    vk::Format depth;
    vk::SampleCountFlagBits samples;
};

enum class Blending : uint8_t {
    none,
    multiplied, ///< the shader has multiplied by its opacity
    over,       ///< it has not
};

/// What differs between pipelines. Viewport and scissor are set when drawing, a triangle's front is
/// counterclockwise in a projection that turns y over.
struct GraphicsKind {
    std::span<const uint32_t> vertex;   ///< SPIR-V
    std::span<const uint32_t> fragment; ///< SPIR-V
    uint32_t vertex_bytes = 0;          ///< of one vertex in the one buffer; 0: no buffer
    std::span<const vk::VertexInputAttributeDescription> attributes = {};
    vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
    Blending blending = Blending::none;
    bool tests_depth = false;
    bool writes_depth = false;
    vk::CullModeFlags cull = vk::CullModeFlagBits::eNone;
};

/// @throws vk::SystemError: call it within guarded().
vk::raii::Pipeline make_graphics_pipeline(DeviceState& device, const TargetFormat& target,
                                          vk::PipelineLayout layout, const GraphicsKind& kind);

} // namespace anvil
