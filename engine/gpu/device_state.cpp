#include "engine/gpu/device_state.h"

#include <array>
#include <limits>

namespace anvil {

DeviceState::~DeviceState() {
    queue.clear();
    if (borrowed) {
        device.release();
        instance.release();
    }
}

uint32_t DeviceState::memory_type(uint32_t allowed, vk::MemoryPropertyFlags required,
                                  vk::MemoryPropertyFlags preferred) const {
    uint32_t fallback = no_index;
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const vk::MemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((allowed & (1U << i)) == 0 || (flags & required) != required) {
            continue;
        }
        if ((flags & preferred) == preferred) {
            return i;
        }
        fallback = std::min(fallback, i);
    }
    if (fallback == no_index) {
        throw DeviceError("device \"" + info.name + "\" has no memory of the kind needed");
    }
    return fallback;
}

std::string describe_failure(const char* doing, const vk::SystemError& error) {
    const auto result = static_cast<vk::Result>(error.code().value());
    const std::string place = std::string(doing) + ": ";
    switch (result) {
    case vk::Result::eErrorOutOfDeviceMemory:
    case vk::Result::eErrorOutOfHostMemory:
    case vk::Result::eErrorOutOfPoolMemory:
        return place + "the Vulkan device is out of memory; a smaller mesh or `--device cpu` may do";
    case vk::Result::eErrorDeviceLost:
        return place + "the Vulkan device was lost (driver fault or reset); run again, or use `--device cpu`";
    default:
        return place + "Vulkan says " + vk::to_string(result) + "; `--device cpu` works without Vulkan";
    }
}

Commands::Commands(DeviceState& device) : device_(device) {
    guarded("making a command buffer", [&] {
        pool_ = device.device.createCommandPool({.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                 .queueFamilyIndex = device.queue_family});
        const vk::CommandBufferAllocateInfo info{
            .commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1};
        buffer_ = std::move(device.device.allocateCommandBuffers(info).front());
        fence_ = device.device.createFence({});
    });
}

Commands::~Commands() {
    try {
        wait();
    } catch (const DeviceError&) { // a lost device has nothing left to wait for
        pending_ = false;
    }
}

const vk::raii::CommandBuffer& Commands::begin() {
    wait();
    guarded("recording commands", [&] {
        buffer_.reset();
        buffer_.begin({});
        recording_ = true;
    });
    return buffer_;
}

void Commands::end_recording() {
    const vk::MemoryBarrier2 to_host{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                     .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                     .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                     .dstAccessMask = vk::AccessFlagBits2::eHostRead};
    buffer_.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &to_host});
    buffer_.end();
    recording_ = false;
}

void Commands::submit(const vk::SemaphoreSubmitInfo& before, const vk::SemaphoreSubmitInfo& after) {
    wait();
    guarded("handing work to the device", [&] {
        if (recording_) {
            end_recording();
        }
        const vk::CommandBufferSubmitInfo commands{.commandBuffer = *buffer_};
        const std::lock_guard lock(device_.queue_mutex);
        device_.queue.submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = before.semaphore ? 1U : 0U,
                                              .pWaitSemaphoreInfos = &before,
                                              .commandBufferInfoCount = 1,
                                              .pCommandBufferInfos = &commands,
                                              .signalSemaphoreInfoCount = after.semaphore ? 1U : 0U,
                                              .pSignalSemaphoreInfos = &after},
                              *fence_);
        pending_ = true;
    });
}

void Commands::wait() {
    if (!pending_) {
        return;
    }
    guarded("waiting for the device", [&] {
        pending_ = false;
        const vk::Result result =
            device_.device.waitForFences(*fence_, VK_TRUE, std::numeric_limits<uint64_t>::max());
        vk::resultCheck(result, "vkWaitForFences");
        device_.device.resetFences(*fence_);
    });
}

void run_commands(DeviceState& device, const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    Commands commands(device);
    record(commands.begin());
    commands.submit();
    commands.wait();
}

void full_barrier(const vk::raii::CommandBuffer& commands) {
    const auto stages = vk::PipelineStageFlagBits2::eAllCommands;
    const vk::MemoryBarrier2 barrier{.srcStageMask = stages,
                                     .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                     .dstStageMask = stages,
                                     .dstAccessMask = vk::AccessFlagBits2::eMemoryRead |
                                                      vk::AccessFlagBits2::eMemoryWrite};
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

} // namespace anvil
