#include "engine/core/error.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/gpu/selftest.h"
#include "tests/gpu/gpu_test.h"

using namespace anvil;

namespace {

DeviceInfo device(uint32_t index, const char* name, DeviceType type) {
    DeviceInfo info;
    info.index = index;
    info.name = name;
    info.type = type;
    return info;
}

std::vector<DeviceInfo> three_devices() {
    return {device(0, "llvmpipe (LLVM 15)", DeviceType::cpu),
            device(1, "Integrated Graphics 7", DeviceType::integrated),
            device(2, "GeForce Large", DeviceType::discrete)};
}

} // namespace

TEST_CASE("every device is listed with its place, name, driver and version") {
    const std::vector<DeviceInfo> devices = list_devices();
    REQUIRE_FALSE(devices.empty());
    for (size_t i = 0; i < devices.size(); ++i) {
        CHECK(devices[i].index == i);
        CHECK_FALSE(devices[i].name.empty());
        CHECK_FALSE(devices[i].driver.empty());
        CHECK(devices[i].api_version.find('.') != std::string::npos);
    }
    CHECK(devices[choose_device(devices, "auto")].usable());
}

TEST_CASE("auto takes a discrete GPU before an integrated one before a CPU") {
    std::vector<DeviceInfo> devices = three_devices();
    CHECK(choose_device(devices, "auto") == 2);
    CHECK(choose_device(devices, "") == 2);
    devices[2].missing = {"scalarBlockLayout"};
    CHECK(choose_device(devices, "auto") == 1);
    devices[1].missing = {"synchronization2"};
    CHECK(choose_device(devices, "auto") == 0);
    devices[0].missing = {"Vulkan 1.3 (it has 1.1.0)"};
    CHECK_THROWS_AS(choose_device(devices, "auto"), DeviceError);
    CHECK_THROWS_WITH(choose_device(devices, "auto"),
                      Catch::Contains("Vulkan 1.3") && Catch::Contains("--device cpu"));
}

TEST_CASE("a device is chosen by its index or by a part of its name in any case") {
    const std::vector<DeviceInfo> devices = three_devices();
    CHECK(choose_device(devices, "1") == 1);
    CHECK(choose_device(devices, "gEfOrCe") == 2);
    CHECK(choose_device(devices, "7") == 1); // no device 7, but a name with a 7
}

TEST_CASE("a choice that fits no device lists the devices there are") {
    const std::vector<DeviceInfo> devices = three_devices();
    CHECK_THROWS_AS(choose_device(devices, "voodoo"), DeviceError);
    CHECK_THROWS_WITH(choose_device(devices, "voodoo"), Catch::Contains("voodoo") &&
                                                            Catch::Contains("GeForce Large") &&
                                                            Catch::Contains("--device cpu"));
    CHECK_THROWS_AS(choose_device(devices, "3"), DeviceError);
    CHECK_THROWS_WITH(choose_device({}, "auto"), Catch::Contains("no Vulkan device"));
}

TEST_CASE("a chosen device that lacks something is refused by the name of what it lacks") {
    std::vector<DeviceInfo> devices = three_devices();
    devices[2].missing = {"scalarBlockLayout", "a compute queue"};
    CHECK_THROWS_WITH(choose_device(devices, "geforce"),
                      Catch::Contains("scalarBlockLayout") && Catch::Contains("a compute queue"));
}

TEST_CASE("a wanted extension that is missing is named") {
    CHECK_THROWS_WITH(Device(DeviceOptions{.device_extensions = {"VK_ANVIL_none"}}),
                      Catch::Contains("VK_ANVIL_none"));
    CHECK_THROWS_WITH(Device(DeviceOptions{.instance_extensions = {"VK_ANVIL_none"}}),
                      Catch::Contains("VK_ANVIL_none"));
}

TEST_CASE("a device works on borrowed handles and leaves them alive") {
    const CheckedDevice owner;
    const SelftestCase test = selftest_cases().at(1);
    for (int round = 0; round < 2; ++round) {
        const auto borrower = std::make_shared<Device>(owner->handles());
        CHECK(borrower->info().name == owner->info().name);
        CHECK(run_selftest_case(*make_gpu_backend(borrower), test).passed());
    }
    CHECK(run_selftest_case(*make_gpu_backend(owner.shared()), test).passed());
}
