// The benchmark: cases chosen, run and reported.
#pragma once

#include "app/bench/bench_report.h"
#include "app/bench/workshop.h"

#include <functional>

namespace anvil {

struct BenchOptions {
    BenchExtent extent;
    BenchClock clock = BenchClock::wall;
    std::string only; ///< cases whose name contains this; empty: all
};

/// `device_memory`: bytes of the tested device's memory in use. `heard` is given every result as it comes.
/// @throws InputError if no case has `only` in its name, Cancelled.
BenchRun run_bench(Backend& tested, const std::function<uint64_t()>& device_memory,
                   const BenchOptions& options, Progress& progress,
                   const std::function<void(const BenchResult&)>& heard);

} // namespace anvil
