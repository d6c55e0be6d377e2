// What a Device holds; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/core/error.h"
#include "engine/core/types.h"
#include "engine/gpu/device.h"
#include "engine/gpu/vulkan.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace anvil {

/// Filled from the driver's threads.
struct ValidationMessages {
    std::mutex mutex;
    std::vector<std::string> texts;
};

struct DeviceState {
    bool borrowed = false;
    /// Before the instance, which calls back into it while it is destroyed.
    std::unique_ptr<ValidationMessages> messages;
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
    vk::raii::PhysicalDevice physical{nullptr};
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    std::mutex queue_mutex; ///< held while the queue is used: several threads may work with one device
    uint32_t queue_family = 0;
    DeviceInfo info;
    bool wide_integers = false; ///< shaders may have integers of 64 bits
    vk::PhysicalDeviceLimits limits;
    vk::PhysicalDeviceMemoryProperties memory;
    std::atomic<uint64_t> memory_in_use{0}; ///< bytes of buffers and volume textures
    std::atomic<uint64_t> allocations{0};   ///< of such memory, so far
    std::atomic<uint64_t> bytes_written{0}; ///< by the host to buffers, so far

    DeviceState() = default;
    ~DeviceState();
    DeviceState(const DeviceState&) = delete;
    DeviceState& operator=(const DeviceState&) = delete;

    /// Index of a memory type among `allowed` (bit mask) with all of `required`, with `preferred` if
    /// possible.
    /// @throws DeviceError if there is none.
    uint32_t memory_type(uint32_t allowed, vk::MemoryPropertyFlags required,
                         vk::MemoryPropertyFlags preferred) const;
};

/// One readable sentence for a failed Vulkan call.
std::string describe_failure(const char* doing, const vk::SystemError& error);

/// Runs `work`; a Vulkan error becomes a DeviceError that says what was being done.
template <class Work>
decltype(auto) guarded(const char* doing, Work&& work) {
    try {
        return std::forward<Work>(work)();
    } catch (const vk::SystemError& error) {
        throw DeviceError(describe_failure(doing, error));
    }
}

/// The process's one loader. @throws DeviceError if there is none.
vk::raii::Context& vulkan_context();

/// @throws DeviceError if there is no driver or an extension or the validation layer is missing.
vk::raii::Instance make_instance(const std::vector<std::string>& extensions, bool validation);

DeviceInfo describe_device(const vk::raii::PhysicalDevice& physical, uint32_t index);

/// A family with compute, with graphics as well if there is one; none: no_index.
uint32_t pick_queue_family(const vk::raii::PhysicalDevice& physical);

/// A command buffer that is recorded again and again, with its pool and fence: each used by one thread at a
/// time, beside others.
class Commands {
  public:
    explicit Commands(DeviceState& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Waits for the previous submission, then starts a new recording.
    const vk::raii::CommandBuffer& begin();
    /// Makes all writes visible to the host, ends the recording and hands it to the queue; without a new
    /// recording hands over the last one again, after waiting for it.
    void submit() { submit({}, {}); }
    /// The same; the work waits for one of the semaphores and signals the other, if they are given.
    void submit(const vk::SemaphoreSubmitInfo& before, const vk::SemaphoreSubmitInfo& after);
    /// Blocks until the submission is done; returns at once if there is none.
    void wait();

  private:
    void end_recording();

    DeviceState& device_;
    vk::raii::CommandPool pool_{nullptr};
    vk::raii::CommandBuffer buffer_{nullptr};
    vk::raii::Fence fence_{nullptr};
    bool recording_ = false;
    bool pending_ = false;
};

/// Records, submits and waits; for set-up work, not for the drag loop.
void run_commands(DeviceState& device, const std::function<void(const vk::raii::CommandBuffer&)>& record);

/// Everything recorded before is done and visible before anything recorded after (compute, transfer, host).
void full_barrier(const vk::raii::CommandBuffer& commands);

} // namespace anvil
