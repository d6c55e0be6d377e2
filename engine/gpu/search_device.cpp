#include "engine/gpu/search_device.h"

#include "engine/gpu/compute_kernel.h"
#include "engine/gpu/guards.h"

#include "embedded/nearest_triangles.comp.h"

namespace anvil {

static_assert(sizeof(kernel::f32::TreeNode) == 32); // as the shader has them
static_assert(sizeof(kernel::f32::TreeTriangle) == 60);

namespace {

constexpr uint32_t search_workgroup = 64; // local_size_x of shaders/nearest_triangles.comp
constexpr uint64_t guard_bytes = search_workgroup * sizeof(NearSlots); // a whole workgroup beyond the end

uint32_t points_at_once(const DeviceState& device, uint64_t chunk_bytes) {
    const uint64_t bytes = std::min<uint64_t>(chunk_bytes, device.limits.maxStorageBufferRange);
    const uint64_t points = bytes > guard_bytes ? (bytes - guard_bytes) / sizeof(NearSlots) : 0;
    return static_cast<uint32_t>(std::max<uint64_t>(points, 1));
}

class GpuSearch final : public TriangleSearch {
  public:
    GpuSearch(DeviceState& device, const ComputeKernel& kernel, const NarrowTree& tree, uint32_t at_once)
        : kernel_(kernel), at_once_(at_once),
          nodes_(storage_buffer(device, std::span<const kernel::f32::TreeNode>(tree.nodes))),
          triangles_(storage_buffer(device, std::span<const kernel::f32::TreeTriangle>(tree.triangles))),
          points_(device, uint64_t{at_once} * sizeof(glm::vec3), vk::BufferUsageFlagBits::eStorageBuffer,
                  MemoryUse::upload),
          found_(device, uint64_t{at_once} * sizeof(NearSlots) + guard_bytes,
                 vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device),
          commands_(device) {}

    bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) override {
        for (size_t first = 0; first < points.size(); first += at_once_) {
            const size_t count = std::min<size_t>(at_once_, points.size() - first);
            find_some(points.subspan(first, count), found.subspan(first, count));
        }
        return true;
    }

  private:
    void find_some(std::span<const glm::vec3> points, std::span<NearSlots> found) {
        const std::vector<std::byte> guards = make_guards(guard_bytes);
        points_.write(0, std::as_bytes(points));
        found_.write(found.size_bytes(), guards);
        const std::array<Resource, 4> resources{BufferRange(nodes_), BufferRange(triangles_),
                                                BufferRange(points_), BufferRange(found_)};
        const vk::raii::CommandBuffer& commands = commands_.begin();
        full_barrier(commands);
        const auto count = static_cast<uint32_t>(points.size());
        kernel_.record(commands, resources, count, count);
        full_barrier(commands);
        commands_.submit();
        commands_.wait();
        found_.read(0, std::as_writable_bytes(found));
        std::vector<std::byte> behind(guard_bytes);
        found_.read(found.size_bytes(), behind);
        if (!guards_intact(behind)) {
            throw InternalError("the search kernel wrote behind its results");
        }
    }

    const ComputeKernel& kernel_;
    uint32_t at_once_;
    Buffer nodes_;
    Buffer triangles_;
    Buffer points_;
    Buffer found_;
    Commands commands_;
};

class GpuSearchDevice final : public SearchDevice {
  public:
    GpuSearchDevice(std::shared_ptr<Device> device, const SearchDeviceOptions& options)
        : device_(std::move(device)), kernel_(device_->state(), nearest_triangles_comp,
                                              std::vector<ResourceKind>(4, ResourceKind::storage_buffer),
                                              sizeof(uint32_t), search_workgroup),
          at_once_(points_at_once(device_->state(), options.chunk_bytes)), log_(options.log),
          most_bytes_(std::min<uint64_t>(options.tree_bytes, device_->state().limits.maxStorageBufferRange)) {
    }

    std::unique_ptr<TriangleSearch> put(const NarrowTree& tree) override {
        const uint64_t bytes = tree.triangles.size() * sizeof(kernel::f32::TreeTriangle); // nodes take less
        if (bytes > most_bytes_ && log_ != nullptr) {
            log_->warn("a mesh has more triangles than device \"" + device_->info().name + "\" bakes (" +
                       std::to_string(most_bytes_ / sizeof(kernel::f32::TreeTriangle)) +
                       "): its distance field is baked on the CPU, which gives the same one");
        }
        if (tree.nodes.empty() || bytes > most_bytes_) {
            return nullptr;
        }
        return std::make_unique<GpuSearch>(device_->state(), kernel_, tree, at_once_);
    }

  private:
    std::shared_ptr<Device> device_;
    ComputeKernel kernel_;
    uint32_t at_once_;
    Log* log_;            ///< nullptr: none
    uint64_t most_bytes_; ///< of one buffer
};

} // namespace

std::unique_ptr<SearchDevice> make_search_device(std::shared_ptr<Device> device,
                                                 const SearchDeviceOptions& options) {
    return std::make_unique<GpuSearchDevice>(std::move(device), options);
}

} // namespace anvil
