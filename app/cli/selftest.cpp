#include "engine/gpu/selftest.h"
#include "app/backend_choice.h"
#include "app/cli/command.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <memory>

namespace anvil {

namespace {

std::string padded(std::string text, size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string row(const std::string& name, const std::string& points, const std::string& worst,
                const std::string& allowed, const std::string& bifurcating, const std::string& verdict) {
    return padded(name, 44) + padded(points, 8) + padded(worst, 13) + padded(allowed, 11) +
           padded(bifurcating, 13) + verdict + "\n";
}

std::string verdict(const SelftestResult& result) {
    if (result.passed()) {
        return "ok";
    }
    return "BAD: " + std::to_string(result.non_finite) + " not finite, " + std::to_string(result.deviating) +
           " deviate, " + std::to_string(result.penetrating) + " inside";
}

void run(const std::string& device, CommandContext& context) {
    const ChosenBackend tested = open_backend(device, DeviceBaking::always);
    const std::vector<SelftestCase> cases = selftest_cases();
    SearchDevice* const baking = tested.backend->search_device();
    std::string text = tested.backend->device_name() + " against the double-precision reference\n" +
                       row("case", "points", "worst", "allowed", "bifurcating", "");
    std::vector<SelftestResult> results;
    for (size_t i = 0; i < cases.size(); ++i) {
        context.progress.report("selftest", static_cast<double>(i) / static_cast<double>(cases.size()));
        results.push_back(run_selftest_case(*tested.backend, cases[i]));
    }
    if (baking != nullptr) {
        results.push_back(run_baking_selftest(*baking));
    }
    size_t failures = 0;
    for (const SelftestResult& result : results) {
        text += row(result.name, std::to_string(result.points), rounded_text(result.worst),
                    rounded_text(result.allowed), std::to_string(result.bifurcating), verdict(result));
        failures += result.passed() ? 0 : 1;
    }
    text += std::to_string(results.size() - failures) + " of " + std::to_string(results.size()) +
            " cases hold; deviations are fractions of the diagonal\n";
    write_text("", text);
    check_validation(tested.device);
    if (failures > 0) {
        throw DeviceError(tested.backend->device_name() + " deviates from the reference in " +
                          std::to_string(failures) + " cases; try another driver, or --device cpu");
    }
}

} // namespace

void add_selftest(Program& program, CommandContext& context) {
    auto device = std::make_shared<std::string>("auto");
    Command command = program.add_command("selftest", "Hold a device against the double-precision reference",
                                          "anvil selftest --device auto");
    command.option("--device", *device, "auto, cpu, or a Vulkan device by name or index");
    command.run([device, &context] { run(*device, context); });
}

} // namespace anvil
