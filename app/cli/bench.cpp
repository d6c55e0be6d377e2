#include "app/bench/bench.h"
#include "app/backend_choice.h"
#include "app/bench/comparison.h"
#include "app/cli/command.h"
#include "app/cli/progress_bar.h"

#include <memory>
#include <optional>

namespace anvil {

namespace {

struct Options {
    std::string json;
    std::string compare;
    std::string device = "auto";
    bool processor_time = false;
    BenchOptions bench;
};

/// Unlike elsewhere `auto` takes Vulkan on a CPU too, where there is no GPU: it is what is to be measured,
/// and the CPU back end stands beside it in any case. It bakes too, faster or not.
ChosenBackend backend_to_measure(const std::string& device, Log& log) {
    const bool none = device == "auto" && devices_or_none(log).empty();
    return open_backend(none ? "cpu" : device, DeviceBaking::always);
}

void compare(const BenchRun& before, const BenchRun& now, const std::string& file, Log& log) {
    if (before.machine.cpu != now.machine.cpu || before.machine.device != now.machine.device) {
        log.warn(file + ": was measured on " + before.machine.device + ", " + before.machine.cpu +
                 "; this is another machine");
    }
    if (before.clock != now.clock) {
        log.warn(file + ": counts seconds of another clock: only one of the two runs has --processor-time");
    }
    write_text("", comparison_text(changes_since(before, now)));
}

void run(const Options& options, CommandContext& context) {
    std::optional<BenchRun> before; // read first: its faults show before minutes have gone
    if (!options.compare.empty()) {
        before = read_bench_json(options.compare);
    }
    const ChosenBackend tested = backend_to_measure(options.device, context.log);
    bool first = true;
    const auto device_memory = [&tested] { return tested.device ? tested.device->memory_in_use() : 0; };
    const BenchRun now = run_bench(
        *tested.backend, device_memory, options.bench, context.progress, [&](const BenchResult& result) {
            clear_progress_bar();
            write_text("", (first ? table_head(this_machine(*tested.backend)) : "") + table_row(result));
            first = false;
        });
    if (!options.json.empty()) {
        write_text(options.json, bench_json(now));
    }
    if (before) {
        compare(*before, now, options.compare, context.log);
    }
    check_validation(tested.device);
}

} // namespace

void add_bench(Program& program, CommandContext& context) {
    auto options = std::make_shared<Options>();
    Command command = program.add_command(
        "bench", "Measure this machine: kernels, distances, files, refinement, baking, beside yardsticks",
        "anvil bench --quick --json now.json --compare before.json");
    command.option("--json", options->json, "Write the results as JSON to this file");
    command.option("--only", options->bench.only, "Only cases with this in their name, e.g. forge/dense");
    command.flag("--quick", options->bench.extent.quick, "Fewer cases, smaller meshes: under a minute");
    command.option("--compare", options->compare,
                   "JSON of an earlier run: says which cases are slower by more than 15 %, measured by "
                   "yardsticks of the same run; the exit status stays 0");
    command.option("--device", options->device,
                   "auto (any Vulkan device, also one on the CPU), cpu, or a Vulkan device by name or index");
    command.flag("--processor-time", options->processor_time,
                 "Count the seconds that this program's threads compute: steadier where other programs run, "
                 "but blind to what a GPU does");
    command.run([options, &context] {
        options->bench.clock = options->processor_time ? BenchClock::processor : BenchClock::wall;
        run(*options, context);
    });
}

} // namespace anvil
