// Draws a scene's meshes; see shaders/viewer/mesh.vert.
#pragma once

#include "app/viewer/scene.h"
#include "engine/gpu/graphics_pipeline.h"

namespace anvil {

namespace shader {
using glm::mat4;
using glm::vec4;
using uint = uint32_t;
#include "shaders/viewer/mesh_parameters.h"
} // namespace shader

class ScenePass {
  public:
    /// @throws DeviceError
    ScenePass(DeviceState& device, const TargetFormat& target);

    /// Before the rendering begins: what an earlier call recorded is done.
    void prepare(const Scene& scene);
    /// How many triangles and lines there are to draw; what is drawn twice counts twice.
    uint64_t size(const Scene& scene) const;
    /// Within a rendering of the target. A scene can be drawn in parts: of what size() counts those from
    /// `first` up to `last`, the first ones (0) over nothing, others over what was drawn before.
    void record(const vk::raii::CommandBuffer& commands, const Scene& scene, uint64_t first,
                uint64_t last) const;

  private:
    /// What one call draws.
    struct Draw {
        const vk::raii::Pipeline* pipeline;
        const SceneItem* item;
        bool lines;

        uint32_t corners() const { return lines ? 2 : 3; }
        const DrawnIndices& indices() const { return item->indices ? *item->indices : item->mesh->indices; }
        uint32_t count() const; ///< triangles or lines
    };

    std::vector<Draw> draws(const Scene& scene) const;
    void record(const vk::raii::CommandBuffer& commands, const Scene& scene, const Draw& draw, uint32_t first,
                uint32_t last) const;
    void bind(const vk::raii::CommandBuffer& commands, const SceneItem& item) const;
    static void number_region(DrawnMesh& mesh, const std::shared_ptr<const DrawnRegion>& region);

    DeviceState& device_;
    Buffer camera_;  ///< the projection
    Buffer nothing_; ///< where an item has no region
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::PipelineLayout background_layout_{nullptr};
    vk::raii::Pipeline background_{nullptr};
    vk::raii::Pipeline opaque_{nullptr};
    vk::raii::Pipeline lines_{nullptr};
    vk::raii::Pipeline translucent_back_{nullptr};
    vk::raii::Pipeline translucent_front_{nullptr};
};

} // namespace anvil
