#include "engine/gpu/surface_pipelines.h"

#include "engine/gpu/surface_vertices.h"

#include "embedded/background.frag.h"
#include "embedded/background.vert.h"
#include "embedded/surface.frag.h"
#include "embedded/surface.vert.h"

#include <array>
#include <cstddef>
#include <span>

namespace anvil {

namespace {

static_assert(sizeof(shader::SurfaceParameters) == 80);

/// What differs between the pipelines.
struct PipelineKind {
    std::span<const uint32_t> vertex;
    std::span<const uint32_t> fragment;
    bool reads_vertices;
    bool blends;
    bool writes_depth;
    vk::CullModeFlags cull;
};

constexpr std::array<vk::VertexInputAttributeDescription, 4> attributes{{
    {0, 0, vk::Format::eR32G32B32Sfloat, offsetof(SurfaceVertex, position)},
    {1, 0, vk::Format::eR32G32B32Sfloat, offsetof(SurfaceVertex, normal)},
    {2, 0, vk::Format::eR32Sfloat, offsetof(SurfaceVertex, tint)},
    {3, 0, vk::Format::eR8G8B8A8Unorm, offsetof(SurfaceVertex, colour)},
}};

vk::PipelineColorBlendAttachmentState blending(bool blends) {
    using Bit = vk::ColorComponentFlagBits;
    // The shader multiplies by its opacity.
    return {.blendEnable = blends ? VK_TRUE : VK_FALSE,
            .srcColorBlendFactor = vk::BlendFactor::eOne,
            .dstColorBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
            .srcAlphaBlendFactor = vk::BlendFactor::eOne,
            .dstAlphaBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
            .colorWriteMask = Bit::eR | Bit::eG | Bit::eB | Bit::eA};
}

vk::raii::Pipeline make_pipeline(DeviceState& device, const TargetFormat& target, vk::PipelineLayout layout,
                                 const PipelineKind& kind) {
    const vk::raii::ShaderModule vertex =
        device.device.createShaderModule({.codeSize = kind.vertex.size_bytes(), .pCode = kind.vertex.data()});
    const vk::raii::ShaderModule fragment = device.device.createShaderModule(
        {.codeSize = kind.fragment.size_bytes(), .pCode = kind.fragment.data()});
    const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
        {{.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
         {.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}}};
    const vk::VertexInputBindingDescription binding{0, sizeof(SurfaceVertex), vk::VertexInputRate::eVertex};
    vk::PipelineVertexInputStateCreateInfo input;
    if (kind.reads_vertices) {
        input = {.vertexBindingDescriptionCount = 1,
                 .pVertexBindingDescriptions = &binding,
                 .vertexAttributeDescriptionCount = attributes.size(),
                 .pVertexAttributeDescriptions = attributes.data()};
    }
    const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    // The projection turns y over, which keeps counterclockwise triangles counterclockwise on the picture.
    const vk::PipelineRasterizationStateCreateInfo raster{
        .cullMode = kind.cull, .frontFace = vk::FrontFace::eCounterClockwise, .lineWidth = 1.0F};
    const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = target.samples};
    const vk::PipelineDepthStencilStateCreateInfo depth{
        .depthTestEnable = kind.reads_vertices ? VK_TRUE : VK_FALSE,
        .depthWriteEnable = kind.writes_depth ? VK_TRUE : VK_FALSE,
        .depthCompareOp = vk::CompareOp::eLess};
    const vk::PipelineColorBlendAttachmentState attachment = blending(kind.blends);
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &attachment};
    const std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamics{.dynamicStateCount = dynamic.size(),
                                                      .pDynamicStates = dynamic.data()};
    const vk::PipelineRenderingCreateInfo rendering{.colorAttachmentCount = 1,
                                                    .pColorAttachmentFormats = &target.colour,
                                                    .depthAttachmentFormat = target.depth};
    return device.device.createGraphicsPipeline(nullptr, {.pNext = &rendering,
                                                          .stageCount = stages.size(),
                                                          .pStages = stages.data(),
                                                          .pVertexInputState = &input,
                                                          .pInputAssemblyState = &assembly,
                                                          .pViewportState = &viewport,
                                                          .pRasterizationState = &raster,
                                                          .pMultisampleState = &multisample,
                                                          .pDepthStencilState = &depth,
                                                          .pColorBlendState = &blend,
                                                          .pDynamicState = &dynamics,
                                                          .layout = layout});
}

} // namespace

SurfacePipelines::SurfacePipelines(DeviceState& device, const TargetFormat& target) {
    guarded("preparing to draw", [&] {
        const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eVertex |
                                                        vk::ShaderStageFlagBits::eFragment,
                                          .size = sizeof(shader::SurfaceParameters)};
        layout =
            device.device.createPipelineLayout({.pushConstantRangeCount = 1, .pPushConstantRanges = &range});
        const auto none = vk::CullModeFlagBits::eNone;
        const auto front = vk::CullModeFlagBits::eFront;
        const auto back = vk::CullModeFlagBits::eBack;
        background = make_pipeline(device, target, *layout,
                                   {background_vert, background_frag, false, false, false, none});
        opaque =
            make_pipeline(device, target, *layout, {surface_vert, surface_frag, true, false, true, none});
        translucent_back =
            make_pipeline(device, target, *layout, {surface_vert, surface_frag, true, true, false, front});
        translucent_front =
            make_pipeline(device, target, *layout, {surface_vert, surface_frag, true, true, false, back});
    });
}

} // namespace anvil
