#include "app/viewer/scene_pass.h"

#include "embedded/background.frag.h"
#include "embedded/background.vert.h"
#include "embedded/mesh.frag.h"
#include "embedded/mesh.vert.h"

#include <algorithm>
#include <array>

namespace anvil {

namespace {

constexpr uint32_t binding_count = 8;
constexpr vk::ShaderStageFlags both = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
const glm::vec4 edge_colour(0.02F, 0.02F, 0.025F, 0.35F);

static_assert(sizeof(shader::MeshParameters) == 100);
static_assert(sizeof(RegionMark) == 8);

GraphicsKind mesh_kind(Blending blending, vk::CullModeFlags cull) {
    return {.vertex = mesh_vert,
            .fragment = mesh_frag,
            .blending = blending,
            .tests_depth = true,
            .writes_depth = blending == Blending::none,
            .cull = cull};
}

bool is_translucent(const SceneItem& item) {
    return item.colour.a < 1;
}

shader::MeshParameters parameters_of(const SceneItem& item, const Scene& scene, bool lines) {
    shader::MeshParameters parameters{};
    parameters.model_view = item.model_view;
    parameters.colour = lines ? edge_colour : item.colour;
    parameters.flags = (item.region ? MESH_HAS_REGION : 0U) | (item.flat ? MESH_FLAT : 0U) |
                       (lines ? MESH_LINES : 0U) | (item.tinted ? MESH_TINTED : 0U) |
                       (item.contour_spacing > 0 ? MESH_CONTOURS : 0U) |
                       (item.plain_back ? MESH_PLAIN_BACK : 0U) | (item.selected ? MESH_SELECTION : 0U) |
                       static_cast<uint32_t>(item.lights) * MESH_LIGHTS;
    parameters.point_count = item.region ? item.region->surface.point_count : 0;
    parameters.contour_spacing = item.contour_spacing;
    parameters.contour_end = item.contour_end;
    parameters.orthographic = scene.orthographic ? 1.0F : 0.0F;
    return parameters;
}

} // namespace

ScenePass::ScenePass(DeviceState& device, const TargetFormat& target)
    : device_(device),
      camera_(device, sizeof(glm::mat4), vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::upload),
      nothing_(storage_buffer(device, std::span<const glm::vec4>(std::array{glm::vec4(0)}))) {
    guarded("preparing to draw", [&] {
        std::array<vk::DescriptorSetLayoutBinding, binding_count> bindings;
        for (uint32_t i = 0; i < binding_count; ++i) {
            bindings[i] = {.binding = i,
                           .descriptorType = vk::DescriptorType::eStorageBuffer,
                           .descriptorCount = 1,
                           .stageFlags = vk::ShaderStageFlagBits::eVertex};
        }
        set_layout_ = device.device.createDescriptorSetLayout(
            {.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
             .bindingCount = binding_count,
             .pBindings = bindings.data()});
        const vk::PushConstantRange range{.stageFlags = both, .size = sizeof(shader::MeshParameters)};
        layout_ = device.device.createPipelineLayout({.setLayoutCount = 1,
                                                      .pSetLayouts = &*set_layout_,
                                                      .pushConstantRangeCount = 1,
                                                      .pPushConstantRanges = &range});
        background_layout_ = device.device.createPipelineLayout({});
        background_ = make_graphics_pipeline(device, target, *background_layout_,
                                             {.vertex = background_vert, .fragment = background_frag});
        const auto make = [&](const GraphicsKind& kind) {
            return make_graphics_pipeline(device, target, *layout_, kind);
        };
        opaque_ = make(mesh_kind(Blending::none, vk::CullModeFlagBits::eNone));
        translucent_back_ = make(mesh_kind(Blending::multiplied, vk::CullModeFlagBits::eFront));
        translucent_front_ = make(mesh_kind(Blending::multiplied, vk::CullModeFlagBits::eBack));
        GraphicsKind edges = mesh_kind(Blending::over, vk::CullModeFlagBits::eNone);
        edges.topology = vk::PrimitiveTopology::eLineList;
        lines_ = make(edges);
    });
}

void ScenePass::number_region(DrawnMesh& mesh, const std::shared_ptr<const DrawnRegion>& region) {
    if (mesh.numbered == region) {
        return;
    }
    const auto write = [&](const DrawnRegion& numbered, bool clear) {
        for (uint32_t i = 0; i < numbered.vertices.size(); ++i) {
            const uint32_t slot = clear ? no_index : i;
            mesh.slots.write(numbered.vertices[i] * sizeof(uint32_t), std::as_bytes(std::span(&slot, 1)));
        }
    };
    if (!mesh.numbered || !region || mesh.numbered->vertices != region->vertices) {
        if (mesh.numbered) {
            write(*mesh.numbered, true);
        }
        if (region) {
            write(*region, false);
        }
    }
    mesh.numbered = region;
}

void ScenePass::prepare(const Scene& scene) {
    camera_.write_all(std::span<const glm::mat4>(&scene.projection, 1));
    for (const SceneItem& item : scene.items) {
        if (item.mesh->slots.size() > 0) {
            number_region(*item.mesh, item.region);
        }
    }
}

void ScenePass::bind(const vk::raii::CommandBuffer& commands, const SceneItem& item) const {
    const auto whole = [](vk::Buffer buffer) { return vk::DescriptorBufferInfo{buffer, 0, VK_WHOLE_SIZE}; };
    const vk::Buffer none = nothing_.handle();
    const DrawnRegion* region = item.region.get();
    const std::array<vk::DescriptorBufferInfo, binding_count> buffers{
        whole(camera_.handle()),
        whole(item.mesh->positions.handle()),
        whole(item.mesh->normals.handle()),
        whole(region != nullptr ? item.mesh->slots.handle() : none),
        whole(region != nullptr ? region->surface.ends : none),
        whole(region != nullptr ? region->surface.normals : none),
        whole(region != nullptr ? region->marks->handle() : none),
        whole(item.selected ? item.selected->handle() : none)};
    std::array<vk::WriteDescriptorSet, binding_count> writes;
    for (uint32_t i = 0; i < binding_count; ++i) {
        writes[i] = vk::WriteDescriptorSet{.dstBinding = i,
                                           .descriptorCount = 1,
                                           .descriptorType = vk::DescriptorType::eStorageBuffer,
                                           .pBufferInfo = &buffers[i]};
    }
    commands.pushDescriptorSetKHR(vk::PipelineBindPoint::eGraphics, *layout_, 0, writes);
}

uint32_t ScenePass::Draw::count() const {
    return (lines ? indices().line_indices : indices().triangle_indices) / corners();
}

std::vector<ScenePass::Draw> ScenePass::draws(const Scene& scene) const {
    std::vector<Draw> draws;
    for (const SceneItem& item : scene.items) {
        if (!is_translucent(item)) {
            draws.push_back({&opaque_, &item, false});
        }
        if (item.edges) {
            draws.push_back({&lines_, &item, true});
        }
    }
    for (const SceneItem& item : scene.items) { // farthest first: the caller's order
        if (is_translucent(item)) {
            draws.push_back({&translucent_back_, &item, false});
            draws.push_back({&translucent_front_, &item, false});
        }
    }
    return draws;
}

uint64_t ScenePass::size(const Scene& scene) const {
    uint64_t size = 0;
    for (const Draw& draw : draws(scene)) {
        size += draw.count();
    }
    return size;
}

void ScenePass::record(const vk::raii::CommandBuffer& commands, const Scene& scene, const Draw& draw,
                       uint32_t first, uint32_t last) const {
    const DrawnIndices& indices = draw.indices();
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, **draw.pipeline);
    bind(commands, *draw.item);
    commands.pushConstants<shader::MeshParameters>(*layout_, both, 0,
                                                   parameters_of(*draw.item, scene, draw.lines));
    commands.bindIndexBuffer(draw.lines ? indices.lines.handle() : indices.triangles.handle(), 0,
                             vk::IndexType::eUint32);
    commands.drawIndexed((last - first) * draw.corners(), 1, first * draw.corners(), 0, 0);
}

void ScenePass::record(const vk::raii::CommandBuffer& commands, const Scene& scene, uint64_t first,
                       uint64_t last) const {
    if (first == 0 && !scene.over_picture) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *background_);
        commands.draw(3, 1, 0, 0);
    }
    uint64_t begin = 0; // of the draw
    for (const Draw& draw : draws(scene)) {
        const uint64_t end = begin + draw.count();
        const uint64_t from = std::max(first, begin);
        const uint64_t to = std::min(last, end);
        if (from < to) {
            record(commands, scene, draw, static_cast<uint32_t>(from - begin),
                   static_cast<uint32_t>(to - begin));
        }
        begin = end;
    }
}

} // namespace anvil
