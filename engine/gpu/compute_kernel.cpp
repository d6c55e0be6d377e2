#include "engine/gpu/compute_kernel.h"

#include <algorithm>
#include <array>

namespace anvil {

namespace {

constexpr uint32_t granted_parameter_bytes = 128; // Vulkan's guaranteed maxPushConstantsSize
constexpr size_t most_resources = 32; // lavapipe's maxPushDescriptors; desktop drivers have as many

vk::DescriptorType descriptor_type(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::storage_buffer:
        return vk::DescriptorType::eStorageBuffer;
    case ResourceKind::uniform_buffer:
        return vk::DescriptorType::eUniformBuffer;
    default:
        return vk::DescriptorType::eCombinedImageSampler;
    }
}

vk::raii::DescriptorSetLayout make_set_layout(DeviceState& device, const std::vector<ResourceKind>& kinds) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    bindings.reserve(kinds.size());
    for (const ResourceKind kind : kinds) {
        bindings.push_back({.binding = static_cast<uint32_t>(bindings.size()),
                            .descriptorType = descriptor_type(kind),
                            .descriptorCount = 1,
                            .stageFlags = vk::ShaderStageFlagBits::eCompute});
    }
    return device.device.createDescriptorSetLayout(
        {.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
         .bindingCount = static_cast<uint32_t>(bindings.size()),
         .pBindings = bindings.data()});
}

} // namespace

ComputeKernel::ComputeKernel(DeviceState& device, std::span<const uint32_t> spirv,
                             std::vector<ResourceKind> kinds, uint32_t parameter_bytes, uint32_t workgroup,
                             std::span<const uint32_t> constants)
    : kinds_(std::move(kinds)), parameter_bytes_(parameter_bytes),
      workgroup_(workgroup), max_groups_{device.limits.maxComputeWorkGroupCount[0],
                                         device.limits.maxComputeWorkGroupCount[1]} {
    if (parameter_bytes > granted_parameter_bytes || kinds_.size() > most_resources) {
        throw InternalError("a kernel wants more parameters or resources than every device grants");
    }
    guarded("preparing a kernel", [&] {
        set_layout_ = make_set_layout(device, kinds_);
        const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eCompute,
                                          .size = parameter_bytes};
        layout_ = device.device.createPipelineLayout({.setLayoutCount = 1,
                                                      .pSetLayouts = &*set_layout_,
                                                      .pushConstantRangeCount = parameter_bytes > 0 ? 1U : 0U,
                                                      .pPushConstantRanges = &range});
        const vk::raii::ShaderModule module =
            device.device.createShaderModule({.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
        std::vector<vk::SpecializationMapEntry> entries;
        for (uint32_t i = 0; i < constants.size(); ++i) {
            entries.push_back({i, static_cast<uint32_t>(i * sizeof(uint32_t)), sizeof(uint32_t)});
        }
        const vk::SpecializationInfo specialization{.mapEntryCount = static_cast<uint32_t>(entries.size()),
                                                    .pMapEntries = entries.data(),
                                                    .dataSize = constants.size_bytes(),
                                                    .pData = constants.data()};
        const vk::ComputePipelineCreateInfo info{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                           .module = *module,
                                                           .pName = "main",
                                                           .pSpecializationInfo = &specialization},
                                                 .layout = *layout_};
        pipeline_ = device.device.createComputePipeline(nullptr, info);
    });
}

void ComputeKernel::push_resources(const vk::raii::CommandBuffer& commands,
                                   std::span<const Resource> resources) const {
    std::array<vk::DescriptorBufferInfo, most_resources> buffers;
    std::array<vk::DescriptorImageInfo, most_resources> images;
    std::array<vk::WriteDescriptorSet, most_resources> writes;
    for (size_t i = 0; i < resources.size(); ++i) {
        writes[i] = vk::WriteDescriptorSet{.dstBinding = static_cast<uint32_t>(i),
                                           .descriptorCount = 1,
                                           .descriptorType = descriptor_type(kinds_[i]),
                                           .pImageInfo = &images[i],
                                           .pBufferInfo = &buffers[i]};
        if (const auto* range = std::get_if<BufferRange>(&resources[i])) {
            buffers[i] = vk::DescriptorBufferInfo{range->buffer->handle(), range->offset, range->bytes};
        } else {
            const VolumeTexture* texture = std::get<const VolumeTexture*>(resources[i]);
            images[i] = vk::DescriptorImageInfo{texture->sampler(), texture->view(),
                                                vk::ImageLayout::eShaderReadOnlyOptimal};
        }
    }
    commands.pushDescriptorSetKHR(
        vk::PipelineBindPoint::eCompute, *layout_, 0,
        vk::ArrayProxy<const vk::WriteDescriptorSet>(static_cast<uint32_t>(resources.size()), writes.data()));
}

void ComputeKernel::record_bytes(const vk::raii::CommandBuffer& commands, std::span<const Resource> resources,
                                 std::span<const std::byte> parameters, uint32_t count) const {
    if (resources.size() != kinds_.size() || parameters.size() != parameter_bytes_) {
        throw InternalError("a kernel got resources or parameters other than it declares");
    }
    if (count == 0) {
        return;
    }
    const uint32_t groups = count / workgroup_ + (count % workgroup_ != 0 ? 1 : 0);
    const uint32_t columns = std::min(groups, max_groups_[0]);
    const uint32_t rows = groups / columns + (groups % columns != 0 ? 1 : 0);
    if (rows > max_groups_[1]) {
        throw InternalError("a dispatch exceeds the device's workgroup counts");
    }
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    push_resources(commands, resources);
    if (!parameters.empty()) {
        commands.pushConstants<std::byte>(*layout_, vk::ShaderStageFlagBits::eCompute, 0,
                                          {static_cast<uint32_t>(parameters.size()), parameters.data()});
    }
    commands.dispatch(columns, rows, 1);
}

} // namespace anvil
