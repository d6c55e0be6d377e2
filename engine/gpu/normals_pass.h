// Normals of a session's surface on a device; internal to engine/gpu.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/gpu/compute_kernel.h"

namespace anvil {

inline constexpr uint32_t normals_workgroup = 64; ///< local_size_x of shaders/normals.comp

/// The kernel, one a device. @throws DeviceError
ComputeKernel make_normals_kernel(DeviceState& device);

class NormalsPass {
  public:
    /// `ends`: places of the points, then of the rim, which this writes; kept, as the kernel is.
    /// `chunk_bytes`: the most that a buffer of one chunk may take. @throws DeviceError
    NormalsPass(DeviceState& device, const ComputeKernel& kernel, const NormalFans& fans, const Buffer& ends,
                uint64_t chunk_bytes);
    NormalsPass(const NormalsPass&) = delete; // its resources name its buffers
    NormalsPass& operator=(const NormalsPass&) = delete;

    /// After a barrier that `ends` waits for.
    void record(const vk::raii::CommandBuffer& commands) const;

    vk::Buffer normals() const { return normals_.handle(); }

    /// The caller has waited for the recorded work.
    std::vector<Vec3> download() const;

  private:
    struct Parameters {
        uint32_t count;
        uint32_t first;
    };
    /// Consecutive vertices with fans of their own, so that no binding exceeds a device's limit.
    struct Chunk {
        Parameters parameters{};
        Buffer begin;
        Buffer corners;
        std::vector<Resource> resources;
    };

    const ComputeKernel& kernel_;
    size_t count_;
    Buffer normals_;
    std::vector<Chunk> chunks_;
};

} // namespace anvil
