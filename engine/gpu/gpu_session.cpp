#include "engine/gpu/gpu_session.h"

#include "engine/core/error.h"
#include "engine/deform/lasting_backend.h"
#include "engine/deform/narrow.h"
#include "engine/gpu/guards.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr uint32_t guard_count = 64; // a whole workgroup beyond the end

template <class Wide>
Buffer narrow_buffer(DeviceState& device, std::span<const Wide> values) {
    const auto narrow = narrowed(values);
    return storage_buffer(device, std::span<const typename decltype(narrow)::value_type>(narrow));
}

/// Writes the values into a buffer, which is made anew where it is too small. @return whether it was.
template <class Narrow>
bool refill(DeviceState& device, Buffer& buffer, const std::vector<Narrow>& values) {
    const std::span<const Narrow> span = values;
    const bool too_small = buffer.size() < std::max(span.size_bytes(), sizeof(Narrow));
    if (too_small) {
        buffer = storage_buffer(device, span, MemoryUse::upload);
    } else {
        buffer.write_all(span);
    }
    return too_small;
}

template <class Wide>
bool refill_narrow(DeviceState& device, Buffer& buffer, const std::vector<Wide>& values) {
    return refill(device, buffer, narrowed(std::span<const Wide>(values)));
}

template <class Wide, class Narrow>
void narrow_into(std::vector<Narrow>& narrow, const std::vector<Wide>& values) {
    narrow.clear();
    std::transform(values.begin(), values.end(), std::back_inserter(narrow),
                   [](const Wide& value) { return narrowed(value); });
}

/// What each point takes in the largest buffer of its chunk.
uint32_t points_per_chunk(const DeviceState& device, size_t handle_count, const FieldBlocks& blocks,
                          uint64_t chunk_bytes) {
    const uint64_t bytes = std::min<uint64_t>(chunk_bytes, device.limits.maxStorageBufferRange);
    const uint64_t guards = guard_count * sizeof(glm::vec3);
    const uint64_t by_results = bytes > guards ? (bytes - guards) / sizeof(glm::vec3) : 0;
    const uint64_t by_fields = bytes / (std::max<size_t>(handle_count, 1) * sizeof(float));
    // Whole workgroups: every offset into a buffer of all points is one that devices bind.
    uint64_t count = std::min({by_results, by_fields, uint64_t{1} << 30}) / guard_count * guard_count;
    if (count > blocks.points) {
        count = count / blocks.points * blocks.points;
    }
    if (count == 0) {
        throw DeviceError("device \"" + device.info.name + "\" cannot bind buffers large enough for " +
                          std::to_string(handle_count) + " handles");
    }
    return static_cast<uint32_t>(count);
}

/// Handles in one block of a field buffer: whole windows.
size_t handles_of_block(size_t handle_count, const FieldBlocks& blocks) {
    const size_t each = std::max(blocks.handles_each, 1U);
    return (handle_count + each - 1) / each * each;
}

/// The values of points [first, first + count), block by block; within one those of each handle, side by
/// side.
Buffer field_buffer(DeviceState& device, const DeformInput& input, const FieldBlocks& blocks, size_t first,
                    uint32_t count) {
    const uint32_t points = blocks.handles_each > 0 ? blocks.points : count;
    const size_t handles = handles_of_block(input.handle_count, blocks);
    const size_t numbers = (count + points - 1) / points * points * handles;
    std::vector<float> values(std::max<size_t>(numbers, 1));
    for (size_t handle = 0; handle < input.handle_count; ++handle) {
        const double* const begin = input.fields.data() + handle * input.points.size() + first;
        for (size_t block = 0; block < count; block += points) {
            const double* const from = begin + block;
            std::transform(from, begin + std::min<size_t>(block + points, count),
                           values.begin() + static_cast<std::ptrdiff_t>(block * handles + handle * points),
                           [](double t) { return narrowed(t); });
        }
    }
    const auto usage = vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformBuffer;
    Buffer buffer(device, values.size() * sizeof(float), usage, MemoryUse::device);
    buffer.write_all(std::span<const float>(values));
    return buffer;
}

Buffer start_distance_buffer(DeviceState& device, const DeformInput& input, size_t first, uint32_t count) {
    if (input.start_distances.empty()) {
        return storage_buffer(device, std::span<const float>(std::vector<float>(count, narrowed(infinity))));
    }
    return narrow_buffer(device, std::span<const double>(input.start_distances).subspan(first, count));
}

/// Three numbers of four bytes a point.
Buffer result_buffer(DeviceState& device, uint32_t count) {
    const uint64_t bytes = (uint64_t{count} + guard_count) * sizeof(glm::vec3);
    Buffer buffer(device, bytes, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
    // Guards in the place of the results too: what a kernel never wrote is told from what it did.
    buffer.write(0, make_guards(bytes));
    return buffer;
}

bool same_bytes(const kernel::f32::KernelParams& a, const kernel::f32::KernelParams& b) {
    const auto first = std::as_bytes(std::span(&a, 1));
    const auto second = std::as_bytes(std::span(&b, 1));
    return std::equal(first.begin(), first.end(), second.begin());
}

/// A motion that moves nothing, to check the sizes of an input before there is a motion.
DeformMotion still(size_t handle_count) {
    DeformMotion motion;
    motion.targets.assign(handle_count, Vec3(0));
    return motion;
}

} // namespace

GpuSession::GpuSession(std::shared_ptr<DeformPipeline> pipeline, std::shared_ptr<const DeformInput> input,
                       uint64_t chunk_bytes)
    : pipeline_(std::move(pipeline)), input_(std::move(input)),
      field_blocks_(pipeline_->field_blocks(input_->handle_count)), commands_(pipeline_->device()) {
    check_sizes(*input_, still(input_->handle_count));
    DeviceState& device = pipeline_->device();
    const size_t n = input_->points.size();
    const uint32_t most = points_per_chunk(device, input_->handle_count, field_blocks_, chunk_bytes);
    for (size_t first = 0; first < n; first += most) {
        chunks_.push_back(make_chunk(static_cast<uint32_t>(first),
                                     static_cast<uint32_t>(std::min<size_t>(most, n - first))));
    }
    if (!input_->fans.empty()) {
        make_ends();
        normals_.emplace(device, pipeline_->normals_kernel(), input_->fans, ends_, chunk_bytes);
    }
    refill(device, poses_, std::vector<kernel::f32::Pose>(1));
    refill(device, targets_, std::vector<glm::vec3>(std::max<size_t>(input_->handle_count, 1)));
    take_shapes();
    take_occluders();
    bind_resources();
}

GpuSession::~GpuSession() {
    try {
        commands_.wait(); // before the buffers go
    } catch (const DeviceError&) {
        return; // a lost device has nothing left to wait for
    }
}

GpuSession::Chunk GpuSession::make_chunk(uint32_t first, uint32_t count) const {
    DeviceState& device = pipeline_->device();
    Chunk chunk;
    chunk.first = first;
    chunk.count = count;
    chunk.points = narrow_buffer(device, std::span<const Vec3>(input_->points).subspan(first, count));
    chunk.fields = field_buffer(device, *input_, field_blocks_, first, count);
    chunk.start_distances = start_distance_buffer(device, *input_, first, count);
    chunk.displacements = result_buffer(device, count);
    for (uint32_t begin = 0; begin < count; begin += field_blocks_.points) {
        chunk.blocks.push_back({begin, std::min(field_blocks_.points, count - begin), {}});
    }
    return chunk;
}

/// The kernels write the points' places; the rim's are those for good.
void GpuSession::make_ends() {
    const std::vector<Vec3>& rim = input_->fans.rim;
    const uint64_t points = input_->points.size() * sizeof(glm::vec3);
    ends_ = Buffer(pipeline_->device(), std::max<uint64_t>(points + rim.size() * sizeof(glm::vec3), 4),
                   vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
    const std::vector<glm::vec3> narrow = narrowed(std::span<const Vec3>(rim));
    ends_.write(points, std::as_bytes(std::span(narrow)));
}

bool GpuSession::take_shapes() {
    const SegmentTable table = segment_table(*input_);
    const bool shapes_grow = refill_narrow(pipeline_->device(), shapes_, table.shapes);
    const bool segments_grow = refill_narrow(pipeline_->device(), segments_, table.segments);
    return shapes_grow || segments_grow;
}

bool GpuSession::take_occluders() {
    const OccluderSet& set = input_->occluders;
    if (set.volumes.size() > kernel::f32::MAX_VOLUMES) {
        throw InternalError("an edit has more densely sampled fields than the kernel binds");
    }
    DeviceState& device = pipeline_->device();
    std::vector<std::shared_ptr<const VolumeTexture>> volumes;
    for (const auto& volume : set.volumes) {
        volumes.push_back(pipeline_->texture(volume));
    }
    auto words = set.field_words ? pipeline_->field_words(set.field_words) : nullptr;
    bool others = volumes != volumes_ || words != field_words_;
    volumes_ = std::move(volumes);
    field_words_ = std::move(words);
    for (Chunk& chunk : chunks_) {
        if (!set.empty() && chunk.counts.size() == 0) {
            chunk.counts = result_buffer(device, chunk.count);
            others = true;
        }
    }
    others = refill_narrow(device, occluders_, set.occluders) || others;
    return refill_narrow(device, nodes_, set.nodes) || others;
}

void GpuSession::refresh_shapes() {
    check_sizes(*input_, still(input_->handle_count));
    commands_.wait();
    if (take_shapes()) {
        bind_resources();
    }
}

void GpuSession::refresh_occluders() {
    check_sizes(*input_, still(input_->handle_count));
    commands_.wait();
    const bool shapes_grow = take_shapes(); // influence curves are among the segments
    const bool others = take_occluders();
    for (Chunk& chunk : chunks_) {
        if (!input_->start_distances.empty()) {
            const std::span<const double> all = input_->start_distances;
            const std::vector<float> narrow = narrowed(all.subspan(chunk.first, chunk.count));
            chunk.start_distances.write_all(std::span<const float>(narrow));
        }
    }
    if (shapes_grow || others) {
        bind_resources();
    }
}

void GpuSession::bind_resources() {
    recorded_.reset();
    for (Chunk& chunk : chunks_) {
        for (Block& block : chunk.blocks) {
            bind_resources(chunk, block);
        }
    }
}

void GpuSession::bind_resources(const Chunk& chunk, Block& block) const {
    std::vector<Resource>& resources = block.resources; // in the order of the shader's bindings
    resources.clear();
    const auto part = [&](const Buffer& buffer, uint64_t bytes_each) {
        return BufferRange(buffer, block.first * bytes_each, block.count * bytes_each);
    };
    const uint64_t handles = handles_of_block(input_->handle_count, field_blocks_);
    const uint64_t field_bytes = block.first * handles * sizeof(float);
    resources.emplace_back(part(chunk.points, sizeof(glm::vec3)));
    resources.emplace_back(BufferRange(chunk.fields, field_bytes, chunk.fields.size() - field_bytes));
    resources.emplace_back(part(chunk.start_distances, sizeof(float)));
    for (const Buffer* buffer : {&shapes_, &segments_, &occluders_, &nodes_, &targets_}) {
        resources.emplace_back(BufferRange(*buffer));
    }
    resources.emplace_back(part(chunk.displacements, sizeof(glm::vec3)));
    for (size_t i = 0; i < kernel::f32::MAX_VOLUMES; ++i) {
        resources.emplace_back(i < volumes_.size() ? volumes_[i].get() : &pipeline_->no_volume());
    }
    resources.emplace_back(BufferRange(poses_));
    resources.emplace_back(BufferRange(field_words_ ? *field_words_ : pipeline_->no_words()));
    // What this variant does not write: anything that blocks do not share.
    resources.emplace_back(input_->fans.empty()
                               ? part(chunk.displacements, sizeof(glm::vec3))
                               : BufferRange(ends_, (uint64_t{chunk.first} + block.first) * sizeof(glm::vec3),
                                             block.count * sizeof(glm::vec3)));
    resources.emplace_back(
        part(chunk.counts.size() > 0 ? chunk.counts : chunk.displacements, sizeof(glm::vec3)));
    const uint64_t windows = field_blocks_.handles_each > 0 ? handles / field_blocks_.handles_each : 0;
    for (uint64_t w = 0; windows > 0 && w < field_windows; ++w) {
        const uint64_t bytes = field_blocks_.handles_each * field_blocks_.points * sizeof(float);
        resources.emplace_back(
            BufferRange(chunk.fields, field_bytes + std::min(w, windows - 1) * bytes, bytes));
    }
}

void GpuSession::upload(const DeformMotion& motion) {
    DeviceState& device = pipeline_->device();
    narrow_into(narrow_targets_, motion.targets);
    bool grown = refill(device, targets_, narrow_targets_);
    if (input_->occluders.moves()) {
        narrow_into(narrow_poses_, kernel_poses(*input_, motion));
        grown = refill(device, poses_, narrow_poses_) || grown;
    }
    if (grown) {
        bind_resources();
    }
}

void GpuSession::update(const DeformMotion& motion) {
    if (!fits_handles(motion, input_->handle_count)) {
        throw InternalError("the deformation's input and motion do not fit each other");
    }
    commands_.wait(); // targets and poses are free to be written
    upload(motion);
    const kernel::f32::KernelParams params = narrowed(kernel_params(*input_, motion));
    const ComputeKernel& kernel = pipeline_->kernel(variant_of(*input_, motion));
    if (!recorded_ || recorded_->second != &kernel || !same_bytes(recorded_->first, params)) {
        recorded_.reset();
        record(params, kernel);
        recorded_.emplace(params, &kernel);
    }
    counted_ = params.occluder_count > 0;
    commands_.submit();
    ready_ = true;
}

void GpuSession::record(const kernel::f32::KernelParams& params, const ComputeKernel& kernel) {
    const vk::raii::CommandBuffer& commands = commands_.begin();
    guarded("recording the deformation", [&] {
        if (normals_) {
            full_barrier(commands); // what draws the last update's surface on this queue has read it
        }
        kernel::f32::KernelParams of_block = params;
        for (const Chunk& chunk : chunks_) {
            of_block.field_stride = field_blocks_.handles_each > 0 ? field_blocks_.points : chunk.count;
            for (const Block& block : chunk.blocks) {
                of_block.point_count = block.count;
                const std::span<const Resource> resources = block.resources;
                kernel.record(commands, resources.first(kernel.resource_count()), of_block, block.count);
            }
        }
        if (normals_) {
            full_barrier(commands);
            normals_->record(commands);
        }
    });
}

void GpuSession::wait() {
    commands_.wait();
}

std::vector<PointResult> GpuSession::download() {
    check_ready();
    commands_.wait();
    std::vector<PointResult> results;
    results.reserve(input_->points.size());
    for (const Chunk& chunk : chunks_) {
        download(chunk, results);
    }
    return results;
}

/// Appends the chunk's.
void GpuSession::download(const Chunk& chunk, std::vector<PointResult>& results) const {
    std::vector<glm::vec3> displacements(chunk.count + guard_count);
    std::vector<glm::uvec3> counts(chunk.count + guard_count, glm::uvec3(0));
    chunk.displacements.read(0, std::as_writable_bytes(std::span(displacements)));
    bool intact = guards_intact(std::as_bytes(std::span(displacements).subspan(chunk.count)));
    if (counted_) {
        chunk.counts.read(0, std::as_writable_bytes(std::span(counts)));
        intact = intact && guards_intact(std::as_bytes(std::span(counts).subspan(chunk.count)));
    }
    if (!intact) {
        throw InternalError("the deformation kernel wrote behind the end of its results");
    }
    for (size_t i = 0; i < chunk.count; ++i) {
        if (guards_intact(std::as_bytes(std::span(displacements).subspan(i, 1)))) {
            throw DeviceError("device \"" + pipeline_->device().info.name +
                              "\" left results unwritten; try another driver, or --device cpu");
        }
        results.push_back({Vec3(displacements[i]), counts[i].x, counts[i].y, counts[i].z});
    }
}

std::vector<Vec3> GpuSession::download_normals() {
    check_ready();
    commands_.wait();
    return normals_ ? normals_->download() : std::vector<Vec3>{};
}

std::optional<DeviceSurface> GpuSession::surface(const Device& device) const {
    if (!normals_ || &device.state() != &pipeline_->device()) {
        return std::nullopt;
    }
    return DeviceSurface{ends_.handle(), normals_->normals(), static_cast<uint32_t>(input_->points.size()),
                         static_cast<uint32_t>(input_->fans.normal_count())};
}

std::optional<DeviceSurface> device_surface(const DeformSession& session, const Device& device) {
    const auto* on_gpu = dynamic_cast<const GpuSession*>(&computing(session));
    return on_gpu != nullptr ? on_gpu->surface(device) : std::nullopt;
}

void GpuSession::check_ready() const {
    if (!ready_) {
        throw InternalError("a session's result was asked for before its first update");
    }
}

} // namespace anvil
