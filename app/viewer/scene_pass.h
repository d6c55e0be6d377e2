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
    /// Within a rendering of the target, over nothing.
    void record(const vk::raii::CommandBuffer& commands, const Scene& scene) const;

  private:
    void draw(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline,
              const SceneItem& item, const Scene& scene, bool lines) const;
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
