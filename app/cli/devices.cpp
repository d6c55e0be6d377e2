#include "app/backend_choice.h"
#include "app/cli/command.h"
#include "engine/gpu/device.h"

#include <optional>

namespace anvil {

namespace {

std::string megabytes(uint64_t bytes) {
    return std::to_string(bytes >> 20) + " MiB";
}

std::string device_text(const DeviceInfo& device, bool taken) {
    std::string text =
        std::to_string(device.index) + "    " + device.name + (taken ? "  <- auto" : "") + "\n";
    const auto line = [&](const std::string& title, const std::string& value) {
        text += "     " + title + std::string(18 - title.size(), ' ') + value + "\n";
    };
    line("kind", to_string(device.type));
    line("driver", device.driver);
    line("Vulkan", device.api_version);
    line("memory", megabytes(device.memory_bytes));
    line("storage binding", megabytes(device.max_storage_binding));
    line("3D texture side", std::to_string(device.max_texture_3d));
    line("pictures", device.graphics ? "yes" : "no");
    for (const std::string& missing : device.missing) {
        line("lacks", missing);
    }
    return text;
}

} // namespace

void add_devices(Program& program, CommandContext& context) {
    Command command = program.add_command(
        "devices", "List the Vulkan devices and which one --device auto takes", "anvil devices");
    command.run([&context] {
        const std::vector<DeviceInfo> devices = devices_or_none(context.log);
        const std::optional<size_t> taken = automatic_device(devices);
        std::string text;
        for (size_t i = 0; i < devices.size(); ++i) {
            text += device_text(devices[i], taken && *taken == i);
        }
        text += std::string("cpu  double-precision reference, without Vulkan") + (taken ? "" : "  <- auto") +
                "\n";
        write_text("", text);
    });
}

} // namespace anvil
