#include "engine/core/error.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/compute_kernel.h"
#include "engine/gpu/guards.h"
#include "engine/gpu/volume_texture.h"
#include "tests/gpu/gpu_test.h"

#include <numeric>
#include <thread>

using namespace anvil;

TEST_CASE("a buffer gives back what was written, whole and in parts") {
    const CheckedDevice device;
    std::vector<uint32_t> values(5000003); // 20 MB: more than one staging copy
    std::iota(values.begin(), values.end(), 7U);
    for (const MemoryUse use : {MemoryUse::device, MemoryUse::upload, MemoryUse::download}) {
        Buffer buffer = storage_buffer(device->state(), std::span<const uint32_t>(values), use);
        std::vector<uint32_t> found(values.size());
        buffer.read(0, std::as_writable_bytes(std::span(found)));
        CHECK(found == values);
        const std::array<uint32_t, 2> part{1, 2};
        buffer.write(400, std::as_bytes(std::span(part)));
        buffer.read(396, std::as_writable_bytes(std::span(found).first(4)));
        CHECK((found[0] == 106 && found[1] == 1 && found[2] == 2 && found[3] == 109));
    }
}

TEST_CASE("a device counts the memory that is held, wherever it is moved, and no longer") {
    const CheckedDevice device;
    const uint64_t before = device->memory_in_use();
    const uint64_t bytes = uint64_t{1} << 20;
    {
        Buffer buffer(device->state(), bytes, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
        const uint64_t held = device->memory_in_use() - before;
        CHECK(held >= bytes);
        Buffer other = std::move(buffer);
        CHECK(device->memory_in_use() - before == held);
        other = Buffer(device->state(), bytes, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
        CHECK(device->memory_in_use() - before == held);
        const VolumeTexture texture(device->state(), {2, 2, 2}, std::vector<float>(32, 1.0F));
        CHECK(device->memory_in_use() - before >= held + 32 * sizeof(float));
    }
    CHECK(device->memory_in_use() == before);
}

TEST_CASE("a copy beyond a buffer's end is a fault of ours") {
    const CheckedDevice device;
    Buffer buffer(device->state(), 16, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device);
    std::array<std::byte, 8> bytes{};
    CHECK_THROWS_AS(buffer.write(9, bytes), InternalError);
    CHECK_THROWS_AS(buffer.read(~uint64_t{0}, bytes), InternalError);
    CHECK_NOTHROW(buffer.write(8, bytes));
}

TEST_CASE("a storage buffer beyond the device's limit is refused with the limit") {
    const CheckedDevice device;
    const uint64_t limit = device->info().max_storage_binding;
    CHECK_THROWS_AS(
        Buffer(device->state(), limit + 4, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device),
        DeviceError);
    CHECK_THROWS_WITH(
        Buffer(device->state(), limit + 4, vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::device),
        Catch::Contains(std::to_string(limit >> 20) + " MiB"));
}

TEST_CASE("memory that the device does not have is a readable error") {
    const CheckedDevice device;
    // As an allocation the driver refuses: more than any device of today holds.
    CHECK_THROWS_AS(
        Buffer(device->state(), uint64_t{1} << 50, vk::BufferUsageFlagBits::eVertexBuffer, MemoryUse::device),
        DeviceError);
}

TEST_CASE("a volume texture checks its texels and the device's limit") {
    const CheckedDevice device;
    const std::vector<float> texels(4 * 8, 1.0F);
    CHECK_NOTHROW(VolumeTexture(device->state(), {2, 2, 2}, texels));
    CHECK_THROWS_AS(VolumeTexture(device->state(), {2, 2, 3}, texels), InternalError);
    CHECK_THROWS_AS(VolumeTexture(device->state(), {0, 2, 2}, {}), InternalError);
    const uint32_t beyond = device->info().max_texture_3d + 1;
    const std::vector<float> line(size_t{4} * beyond);
    CHECK_THROWS_AS(VolumeTexture(device->state(), {beyond, 1, 1}, line), DeviceError);
}

TEST_CASE("a kernel refuses more parameters than every device grants") {
    const CheckedDevice device;
    const std::array<uint32_t, 1> nothing{};
    CHECK_THROWS_AS(ComputeKernel(device->state(), nothing, {}, 132, 64), InternalError);
}

TEST_CASE("guards tell a changed byte anywhere") {
    std::vector<std::byte> guards = make_guards(100);
    CHECK(guards_intact(guards));
    for (const size_t place : {size_t{0}, size_t{50}, size_t{99}}) {
        const std::byte kept = std::exchange(guards[place], std::byte{0});
        CHECK_FALSE(guards_intact(guards));
        guards[place] = kept;
    }
}

TEST_CASE("the validation layer is heard: a removed barrier is reported") {
    Device device(DeviceOptions{.validation = true});
    const auto usage = vk::BufferUsageFlagBits::eStorageBuffer;
    const Buffer a(device.state(), 1024, usage, MemoryUse::device);
    const Buffer b(device.state(), 1024, usage, MemoryUse::device);
    const auto copy_twice = [&](bool barrier) {
        run_commands(device.state(), [&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(a.handle(), b.handle(), vk::BufferCopy{0, 0, 1024});
            if (barrier) {
                full_barrier(commands);
            }
            commands.copyBuffer(b.handle(), a.handle(), vk::BufferCopy{0, 0, 1024});
        });
        return device.take_validation_messages();
    };
    CHECK(copy_twice(true).empty());
    CHECK_FALSE(copy_twice(false).empty());
}

TEST_CASE("two threads copy to and from one device beside each other") {
    const CheckedDevice device; // the layer sees what two threads share without a lock
    const auto copies = [&](uint32_t first, bool& right) {
        std::vector<uint32_t> values(30011);
        std::iota(values.begin(), values.end(), first);
        right = true;
        for (int round = 0; round < 20; ++round) {
            const Buffer buffer =
                storage_buffer(device->state(), std::span<const uint32_t>(values), MemoryUse::device);
            std::vector<uint32_t> found(values.size());
            buffer.read(0, std::as_writable_bytes(std::span(found)));
            right = right && found == values;
        }
    };
    bool right_here = false;
    bool right_there = false;
    std::thread other([&] { copies(1000000, right_there); });
    copies(7, right_here);
    other.join();
    CHECK(right_here);
    CHECK(right_there);
}
