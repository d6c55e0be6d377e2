#include "engine/gpu/gpu_session.h"

#include "engine/core/error.h"
#include "engine/deform/narrow.h"
#include "engine/gpu/guards.h"

#include <algorithm>

namespace anvil {

namespace {

using kernel::f32::VertexResult;

constexpr uint32_t guard_count = 64; // a whole workgroup beyond the end

template <class Wide>
Buffer narrow_buffer(DeviceState& device, std::span<const Wide> values) {
    const auto narrow = narrowed(values);
    return storage_buffer(device, std::span<const typename decltype(narrow)::value_type>(narrow));
}

template <class Wide>
Buffer narrow_buffer(DeviceState& device, const std::vector<Wide>& values) {
    return narrow_buffer(device, std::span<const Wide>(values));
}

/// What each point takes in the largest buffer of its chunk.
uint32_t points_per_chunk(const DeviceState& device, size_t handle_count, uint64_t chunk_bytes) {
    const uint64_t bytes = std::min<uint64_t>(chunk_bytes, device.limits.maxStorageBufferRange);
    const uint64_t guards = guard_count * sizeof(VertexResult);
    const uint64_t by_results = bytes > guards ? (bytes - guards) / sizeof(VertexResult) : 0;
    const uint64_t by_fields = bytes / (std::max<size_t>(handle_count, 1) * sizeof(float));
    const uint64_t count = std::min({by_results, by_fields, uint64_t{1} << 30});
    if (count == 0) {
        throw DeviceError("device \"" + device.info.name + "\" cannot bind buffers large enough for " +
                          std::to_string(handle_count) + " handles");
    }
    return static_cast<uint32_t>(count);
}

/// The values of points [first, first + count) of each handle, side by side.
Buffer field_buffer(DeviceState& device, const DeformInput& input, size_t first, uint32_t count) {
    std::vector<float> values;
    values.reserve(input.handle_count * count);
    for (size_t handle = 0; handle < input.handle_count; ++handle) {
        const auto begin =
            input.fields.begin() + static_cast<std::ptrdiff_t>(handle * input.points.size() + first);
        std::transform(begin, begin + count, std::back_inserter(values),
                       [](double t) { return narrowed(t); });
    }
    return storage_buffer(device, std::span<const float>(values));
}

Buffer start_distance_buffer(DeviceState& device, const DeformInput& input, size_t first, uint32_t count) {
    if (input.start_distances.empty()) {
        return storage_buffer(device, std::span<const float>(std::vector<float>(count, narrowed(infinity))));
    }
    return narrow_buffer(device, std::span<const double>(input.start_distances).subspan(first, count));
}

Buffer result_buffer(DeviceState& device, uint32_t count) {
    Buffer buffer(device, (uint64_t{count} + guard_count) * sizeof(VertexResult),
                  vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
    // Guards in the place of the results too: what a kernel never wrote is told from what it did.
    buffer.write(0, make_guards((uint64_t{count} + guard_count) * sizeof(VertexResult)));
    return buffer;
}

/// A motion that moves nothing, to check the sizes of an input before there is a motion.
DeformMotion still(size_t handle_count) {
    DeformMotion motion;
    motion.targets.assign(handle_count, Vec3(0));
    return motion;
}

DeformInput header_of(const DeformInput& input) {
    DeformInput header;
    header.handle_count = input.handle_count;
    header.occluders = input.occluders;
    return header;
}

} // namespace

GpuSession::GpuSession(std::shared_ptr<DeformPipeline> pipeline, const DeformInput& input,
                       uint64_t chunk_bytes)
    : pipeline_(std::move(pipeline)), header_(header_of(input)), point_count_(input.points.size()),
      commands_(pipeline_->device()) {
    check_sizes(input, still(input.handle_count));
    if (input.occluders.volumes.size() > kernel::f32::MAX_VOLUMES) {
        throw InternalError("an edit has more densely sampled fields than the kernel binds");
    }
    DeviceState& device = pipeline_->device();
    for (const auto& volume : input.occluders.volumes) {
        volumes_.push_back(pipeline_->texture(volume));
    }
    if (input.occluders.field_words) {
        field_words_ = pipeline_->field_words(input.occluders.field_words);
    }
    const SegmentTable table = segment_table(input);
    shapes_ = narrow_buffer(device, table.shapes);
    segments_ = narrow_buffer(device, table.segments);
    occluders_ = narrow_buffer(device, input.occluders.occluders);
    nodes_ = narrow_buffer(device, input.occluders.nodes);
    poses_ = narrow_buffer(device, std::vector<kernel::f64::Pose>(1));
    upload_targets(std::vector<Vec3>(input.handle_count, Vec3(0)));
    const uint32_t most = points_per_chunk(device, input.handle_count, chunk_bytes);
    for (size_t first = 0; first < point_count_; first += most) {
        chunks_.push_back(
            make_chunk(input, first, static_cast<uint32_t>(std::min<size_t>(most, point_count_ - first))));
    }
    std::for_each(chunks_.begin(), chunks_.end(), [this](Chunk& chunk) { bind_resources(chunk); });
}

GpuSession::~GpuSession() {
    try {
        commands_.wait(); // before the buffers go
    } catch (const DeviceError&) {
        return; // a lost device has nothing left to wait for
    }
}

GpuSession::Chunk GpuSession::make_chunk(const DeformInput& input, size_t first, uint32_t count) {
    DeviceState& device = pipeline_->device();
    Chunk chunk;
    chunk.count = count;
    chunk.points = narrow_buffer(device, std::span<const Vec3>(input.points).subspan(first, count));
    chunk.fields = field_buffer(device, input, first, count);
    chunk.start_distances = start_distance_buffer(device, input, first, count);
    chunk.results = result_buffer(device, count);
    return chunk;
}

void GpuSession::bind_resources(Chunk& chunk) {
    chunk.resources.clear(); // in the order of the shader's bindings
    for (const Buffer* buffer : {&chunk.points, &chunk.fields, &chunk.start_distances, &shapes_, &segments_,
                                 &occluders_, &nodes_, &targets_, &chunk.results}) {
        chunk.resources.emplace_back(BufferRange(*buffer));
    }
    for (size_t i = 0; i < kernel::f32::MAX_VOLUMES; ++i) {
        chunk.resources.emplace_back(i < volumes_.size() ? volumes_[i].get() : &pipeline_->no_volume());
    }
    chunk.resources.emplace_back(BufferRange(poses_));
    chunk.resources.emplace_back(BufferRange(field_words_ ? *field_words_ : pipeline_->no_words()));
}

void GpuSession::upload_targets(const std::vector<Vec3>& targets) {
    narrow_targets_.clear();
    std::transform(targets.begin(), targets.end(), std::back_inserter(narrow_targets_),
                   [](const Vec3& v) { return narrowed(v); });
    const std::span<const glm::vec3> values = narrow_targets_;
    if (values.size_bytes() > targets_.size() || targets_.size() == 0) {
        targets_ = storage_buffer(pipeline_->device(), values, MemoryUse::upload);
        std::for_each(chunks_.begin(), chunks_.end(), [this](Chunk& chunk) { bind_resources(chunk); });
        return;
    }
    targets_.write_all(values);
}

void GpuSession::upload_poses(const DeformMotion& motion) {
    if (!header_.occluders.moves()) {
        return;
    }
    poses_ = narrow_buffer(pipeline_->device(), kernel_poses(header_, motion));
    std::for_each(chunks_.begin(), chunks_.end(), [this](Chunk& chunk) { bind_resources(chunk); });
}

void GpuSession::update(const DeformMotion& motion) {
    if (!fits_handles(motion, header_.handle_count)) {
        throw InternalError("the deformation's input and motion do not fit each other");
    }
    const vk::raii::CommandBuffer& commands = commands_.begin(); // waits: the targets are free to be written
    upload_targets(motion.targets);
    upload_poses(motion);
    kernel::f32::KernelParams params = narrowed(kernel_params(header_, motion));
    const ComputeKernel& kernel = pipeline_->kernel(DeformVariant::of(header_.occluders, params));
    guarded("recording the deformation", [&] {
        for (const Chunk& chunk : chunks_) {
            params.point_count = chunk.count;
            params.field_stride = chunk.count;
            kernel.record(commands, chunk.resources, params, chunk.count);
        }
    });
    commands_.submit();
    ready_ = true;
}

void GpuSession::wait() {
    commands_.wait();
}

std::vector<PointResult> GpuSession::download() {
    if (!ready_) {
        throw InternalError("a session's result was asked for before its first update");
    }
    commands_.wait();
    std::vector<PointResult> results;
    results.reserve(point_count_);
    std::vector<VertexResult> raw;
    for (const Chunk& chunk : chunks_) {
        raw.resize(chunk.count + guard_count);
        chunk.results.read(0, std::as_writable_bytes(std::span(raw)));
        if (!guards_intact(std::as_bytes(std::span(raw).subspan(chunk.count)))) {
            throw InternalError("the deformation kernel wrote behind the end of its results");
        }
        for (size_t i = 0; i < chunk.count; ++i) {
            if (guards_intact(std::as_bytes(std::span(raw).subspan(i, 1)))) {
                throw DeviceError("device \"" + pipeline_->device().info.name +
                                  "\" left results unwritten; try another driver, or --device cpu");
            }
            results.push_back({Vec3(raw[i].displacement), raw[i].steps, raw[i].samples, raw[i].flags});
        }
    }
    return results;
}

} // namespace anvil
