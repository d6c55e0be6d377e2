// The deformation kernel on a device and the sampled fields it reads, shared by all sessions; internal to
// engine/gpu.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/gpu/compute_kernel.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace anvil {

inline constexpr uint32_t deform_workgroup = 64; ///< local_size_x of shaders/deform.comp

/// Of the shader's bindings: what every variant has, then the windows of distances of those for CPU devices.
inline constexpr size_t deform_resource_count = 21;
inline constexpr uint32_t field_windows = 8;
inline constexpr uint64_t field_window_bytes = uint64_t{64} << 10;

/// How the distances of a session's points lie in memory: in blocks of `points` points, the handles' side by
/// side; a window of field_window_bytes holds those of `handles_each` handles. A block is worked at once.
struct FieldBlocks {
    uint32_t points = 0;       ///< a multiple of deform_workgroup; as many as one dispatch may have
    uint32_t handles_each = 0; ///< 0: no windows
};

/// What a variant of the kernel is compiled for: its specialization constants, in this order. Drivers inline
/// everything and lavapipe runs both sides of every branch: leaving out what an edit does not need makes it
/// compile in a tenth of the time and run ten times as fast there.
struct DeformVariant {
    uint32_t occluders = 0;   ///< 1: there are any
    uint32_t volumes = 0;     ///< sampled fields: 0, 1, 2, 4 or MAX_VOLUMES
    uint32_t paper = 0;       ///< 1: the paper's literal influence
    uint32_t motion = 0;      ///< MOTION_...
    uint32_t steps = 0;       ///< STEPS_...
    uint32_t one_sample = 0;  ///< 1: the path has one sample
    uint32_t shape_kinds = 0; ///< bit SHAPE_...: there is a node of this kind
    // Where `few`; 4 bits each, the first lowest:
    uint32_t occluder_count = 0;
    uint32_t node_count = 0;    ///< of all
    uint32_t node_counts = 0;   ///< of each occluder
    uint32_t kinds = 0;         ///< of each node
    uint32_t influences = 0;    ///< of each occluder
    uint32_t moving = 0;        ///< 1: occluders move
    uint32_t writes_ends = 0;   ///< 1: into a buffer of places too
    uint32_t points_each = 1;   ///< that one invocation works after each other
    uint32_t kept_handles = 0;  ///< handles whose shapes and targets stay in registers: all or 0
    uint32_t segments_each = 1; ///< of each kept handle's shape
    uint32_t handles_each = 0;  ///< in a window of distances
    bool windows = false;       ///< distances are read from windows (no constant: another shader)
    bool wide = false;          ///< results are stored two points at once (no constant: another shader)
    bool few = false; ///< up to 4 occluders and 8 nodes: kept in registers (no constant: another shader)

    bool operator==(const DeformVariant&) const = default;
};

/// The least variant for an edit; kernel() fits it to the device.
DeformVariant variant_of(const DeformInput& input, const DeformMotion& motion);

class DeformPipeline {
  public:
    /// @throws DeviceError
    explicit DeformPipeline(std::shared_ptr<Device> device);

    DeviceState& device() const { return device_->state(); }
    const DeviceInfo& info() const { return device_->info(); }

    /// What the variant becomes on this device, compiled at the first call; stays as long as this object.
    /// From any thread. @throws DeviceError
    const ComputeKernel& kernel(const DeformVariant& wanted);
    size_t kernel_count(); ///< compiled so far

    /// How fields of so many handles are laid out on this device.
    FieldBlocks field_blocks(size_t handle_count) const;

    const ComputeKernel& normals_kernel() const { return normals_kernel_; }

    /// The field as a texture; uploaded once as long as both live. @throws DeviceError
    std::shared_ptr<const VolumeTexture> texture(const std::shared_ptr<const DistanceVolume>& volume);
    /// The words of all adaptive fields as a buffer; likewise.
    std::shared_ptr<const Buffer> field_words(const std::shared_ptr<const std::vector<uint32_t>>& words);
    /// Bound where a kernel's fields are not used.
    const VolumeTexture& no_volume() const { return no_volume_; }
    const Buffer& no_words() const { return no_words_; }

  private:
    template <class Source, class Upload>
    using Cache = std::vector<std::pair<std::weak_ptr<const Source>, std::weak_ptr<const Upload>>>;

    template <class Source, class Upload, class Make>
    static std::shared_ptr<const Upload>
    cached(Cache<Source, Upload>& cache, const std::shared_ptr<const Source>& source, const Make& make);

    /// Where the device is a CPU, invocations work several points on what they have read once: lavapipe reads
    /// a number that is the same for all once for each of its vector's lanes.
    DeformVariant fitted(DeformVariant variant) const;

    std::shared_ptr<Device> device_;
    std::mutex mutex_; ///< of kernels_
    std::vector<std::pair<DeformVariant, std::unique_ptr<ComputeKernel>>> kernels_;
    ComputeKernel normals_kernel_;
    VolumeTexture no_volume_;
    Buffer no_words_;
    Cache<DistanceVolume, VolumeTexture> textures_;
    Cache<std::vector<uint32_t>, Buffer> words_;
};

} // namespace anvil
