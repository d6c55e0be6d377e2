// A run of the benchmark as a table for people and as JSON.
#pragma once

#include "app/bench/bench_case.h"
#include "app/bench/machine.h"

#include <string>

namespace anvil {

struct BenchRun {
    Machine machine;
    bool quick = false;
    BenchClock clock = BenchClock::wall;
    std::vector<BenchResult> results;
};

/// What stands above the rows: machine and column names.
std::string table_head(const Machine& machine);
/// One line: milliseconds, gigabytes a second, the ratios, and the device's memory where it is much.
std::string table_row(const BenchResult& result);

/// {machine{}, quick, clock, cases[]: {name, vertices, region, samples, median_s, min_s, max_s, bytes,
/// device_bytes, ratio{yardstick: number}}}
std::string bench_json(const BenchRun& run);

/// Reads what bench_json() wrote, as far as a comparison needs it.
/// @throws InputError naming the file, and the place within if it is not of this form.
BenchRun read_bench_json(const std::string& path);

} // namespace anvil
