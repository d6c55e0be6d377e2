#include "app/bench/bench.h"

#include <algorithm>

namespace anvil {

namespace {

std::vector<BenchCase> all_cases(Workshop& workshop, const BenchExtent& extent) {
    std::vector<BenchCase> cases;
    add_deform_cases(cases, workshop, extent);
    add_drag_cases(cases, workshop, extent);
    add_distance_cases(cases, workshop, extent);
    add_file_cases(cases, workshop, extent);
    add_refine_cases(cases, workshop, extent);
    add_bake_cases(cases, workshop, extent);
    return cases;
}

void keep_only(std::vector<BenchCase>& cases, const std::string& only) {
    std::string names;
    for (const BenchCase& bench : cases) {
        names += (names.empty() ? "" : ", ") + bench.name;
    }
    std::erase_if(cases, [&](const BenchCase& bench) { return bench.name.find(only) == std::string::npos; });
    if (cases.empty()) {
        throw InputError("--only " + only + ": is part of no case's name; they are " + names);
    }
}

SamplingEffort effort_of(const BenchOptions& options) {
    return options.extent.quick ? SamplingEffort{3, 25, 0.5, 2, options.clock}
                                : SamplingEffort{3, 25, 2, 2, options.clock};
}

} // namespace

BenchRun run_bench(Backend& tested, const std::function<uint64_t()>& device_memory,
                   const BenchOptions& options, Progress& progress,
                   const std::function<void(const BenchResult&)>& heard) {
    Workshop workshop(tested, progress);
    std::vector<BenchCase> cases = all_cases(workshop, options.extent);
    keep_only(cases, options.only);
    BenchRun run{this_machine(tested), options.extent.quick, options.clock, {}};
    for (size_t i = 0; i < cases.size(); ++i) {
        progress.report("bench " + cases[i].name, static_cast<double>(i) / static_cast<double>(cases.size()));
        run.results.push_back(run_case(cases[i], effort_of(options), device_memory));
        heard(run.results.back());
    }
    return run;
}

} // namespace anvil
