#include "engine/gpu/graphics_pipeline.h"

#include <array>

namespace anvil {

namespace {

vk::PipelineColorBlendAttachmentState attachment_blending(Blending blending) {
    using Bit = vk::ColorComponentFlagBits;
    using Factor = vk::BlendFactor;
    return {.blendEnable = blending == Blending::none ? VK_FALSE : VK_TRUE,
            .srcColorBlendFactor = blending == Blending::over ? Factor::eSrcAlpha : Factor::eOne,
            .dstColorBlendFactor = Factor::eOneMinusSrcAlpha,
            .srcAlphaBlendFactor = Factor::eOne,
            .dstAlphaBlendFactor = Factor::eOneMinusSrcAlpha,
            .colorWriteMask = Bit::eR | Bit::eG | Bit::eB | Bit::eA};
}

vk::raii::ShaderModule module_of(DeviceState& device, std::span<const uint32_t> spirv) {
    return device.device.createShaderModule({.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
}

} // namespace

vk::raii::Pipeline make_graphics_pipeline(DeviceState& device, const TargetFormat& target,
                                          vk::PipelineLayout layout, const GraphicsKind& kind) {
    const vk::raii::ShaderModule vertex = module_of(device, kind.vertex);
    const vk::raii::ShaderModule fragment = module_of(device, kind.fragment);
    const std::array<vk::PipelineShaderStageCreateInfo, 2> stages{
        {{.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
         {.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}}};
    const vk::VertexInputBindingDescription binding{0, kind.vertex_bytes, vk::VertexInputRate::eVertex};
    vk::PipelineVertexInputStateCreateInfo input;
    if (kind.vertex_bytes > 0) {
        input = {.vertexBindingDescriptionCount = 1,
                 .pVertexBindingDescriptions = &binding,
                 .vertexAttributeDescriptionCount = static_cast<uint32_t>(kind.attributes.size()),
                 .pVertexAttributeDescriptions = kind.attributes.data()};
    }
    const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = kind.topology};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    // The projection turns y over, which keeps counterclockwise triangles counterclockwise on the picture.
    const vk::PipelineRasterizationStateCreateInfo raster{
        .cullMode = kind.cull, .frontFace = vk::FrontFace::eCounterClockwise, .lineWidth = 1.0F};
    const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = target.samples};
    const vk::PipelineDepthStencilStateCreateInfo depth{
        .depthTestEnable = kind.tests_depth ? VK_TRUE : VK_FALSE,
        .depthWriteEnable = kind.writes_depth ? VK_TRUE : VK_FALSE,
        .depthCompareOp = vk::CompareOp::eLess};
    const vk::PipelineColorBlendAttachmentState attachment = attachment_blending(kind.blending);
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

} // namespace anvil
