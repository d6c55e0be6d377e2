#include "engine/gpu/surface_pipelines.h"

#include "engine/gpu/surface_vertices.h"

#include "embedded/background.frag.h"
#include "embedded/background.vert.h"
#include "embedded/surface.frag.h"
#include "embedded/surface.vert.h"

#include <array>
#include <cstddef>

namespace anvil {

namespace {

static_assert(sizeof(shader::SurfaceParameters) == 80);

constexpr std::array<vk::VertexInputAttributeDescription, 4> attributes{{
    {0, 0, vk::Format::eR32G32B32Sfloat, offsetof(SurfaceVertex, position)},
    {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(SurfaceVertex, normal)},
    {2, 0, vk::Format::eR32Sfloat, offsetof(SurfaceVertex, tint)},
    {3, 0, vk::Format::eR8G8B8A8Unorm, offsetof(SurfaceVertex, colour)},
}};

GraphicsKind surface_kind(Blending blending, vk::CullModeFlags cull) {
    return {.vertex = surface_vert,
            .fragment = surface_frag,
            .vertex_bytes = sizeof(SurfaceVertex),
            .attributes = attributes,
            .blending = blending,
            .tests_depth = true,
            .writes_depth = blending == Blending::none,
            .cull = cull};
}

} // namespace

SurfacePipelines::SurfacePipelines(DeviceState& device, const TargetFormat& target) {
    guarded("preparing to draw", [&] {
        const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eVertex |
                                                        vk::ShaderStageFlagBits::eFragment,
                                          .size = sizeof(shader::SurfaceParameters)};
        layout =
            device.device.createPipelineLayout({.pushConstantRangeCount = 1, .pPushConstantRanges = &range});
        const auto make = [&](const GraphicsKind& kind) {
            return make_graphics_pipeline(device, target, *layout, kind);
        };
        background = make({.vertex = background_vert, .fragment = background_frag});
        opaque = make(surface_kind(Blending::none, vk::CullModeFlagBits::eNone));
        translucent_back = make(surface_kind(Blending::multiplied, vk::CullModeFlagBits::eFront));
        translucent_front = make(surface_kind(Blending::multiplied, vk::CullModeFlagBits::eBack));
    });
}

} // namespace anvil
