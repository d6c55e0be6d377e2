// One edit on a device; internal to engine/gpu.
#pragma once

#include "engine/deform/backend.h"
#include "engine/gpu/deform_pipeline.h"
#include "engine/gpu/device_surface.h"
#include "engine/gpu/normals_pass.h"

#include <optional>

namespace anvil {

class GpuSession final : public DeformSession {
  public:
    /// `chunk_bytes`: the most that a buffer of one chunk may take. @throws DeviceError, InternalError on
    /// wrong sizes.
    GpuSession(std::shared_ptr<DeformPipeline> pipeline, std::shared_ptr<const DeformInput> input,
               uint64_t chunk_bytes);
    ~GpuSession() override;

    void update(const DeformMotion& motion) override;
    void wait() override;
    std::vector<PointResult> download() override;
    std::vector<Vec3> download_normals() override;
    void refresh_shapes() override;
    void refresh_occluders() override;

    std::optional<DeviceSurface> surface(const Device& device) const;

  private:
    /// Consecutive points of a chunk that one dispatch works.
    struct Block {
        uint32_t first = 0; ///< in the chunk
        uint32_t count = 0;
        std::vector<Resource> resources;
    };
    /// Consecutive points with buffers of their own, so that no binding exceeds a device's limit.
    struct Chunk {
        uint32_t first = 0;
        uint32_t count = 0;
        Buffer points;
        Buffer fields; ///< block by block
        Buffer start_distances;
        Buffer displacements; ///< three floats a point, tightly packed, then guards
        Buffer counts;        ///< steps, samples, flags of each point; none before there are occluders
        std::vector<Block> blocks;
    };

    Chunk make_chunk(uint32_t first, uint32_t count) const;
    void make_ends();
    /// @return whether resources are others now.
    bool take_shapes();
    bool take_occluders();
    void bind_resources();
    void bind_resources(const Chunk& chunk, Block& block) const;
    void download(const Chunk& chunk, std::vector<PointResult>& results) const;
    void check_ready() const;
    void record(const kernel::f32::KernelParams& params, const ComputeKernel& kernel);
    void upload(const DeformMotion& motion);

    std::shared_ptr<DeformPipeline> pipeline_;
    std::shared_ptr<const DeformInput> input_;
    FieldBlocks field_blocks_;
    std::vector<std::shared_ptr<const VolumeTexture>> volumes_;
    std::shared_ptr<const Buffer> field_words_; ///< empty: no adaptive field
    Buffer shapes_;
    Buffer segments_;
    Buffer occluders_;
    Buffer nodes_;
    Buffer targets_;
    Buffer poses_;
    std::vector<glm::vec3> narrow_targets_; ///< kept for their memory
    std::vector<kernel::f32::Pose> narrow_poses_;
    std::vector<Chunk> chunks_;
    Buffer ends_; ///< where the points are, then the rim of the fans; none without fans
    std::optional<NormalsPass> normals_;
    Commands commands_;
    /// What the commands do as they are recorded; none: resources have changed since.
    std::optional<std::pair<kernel::f32::KernelParams, const ComputeKernel*>> recorded_;
    bool counted_ = false; ///< the last update was past occluders
    bool ready_ = false;
};

} // namespace anvil
