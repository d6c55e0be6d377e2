// What `anvil bench` measures, and what comes out.
#pragma once

#include "app/bench/timing.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anvil {

/// Work of another kind that a case is held against in the same run.
struct Yardstick {
    std::string name;
    std::function<void()> work;
};

/// How far results are from those of a path in steps so small that smaller ones change nothing to speak of;
/// parts of the edited mesh's diagonal.
struct StepError {
    double rms = 0;
    double worst_of_99 = 0; ///< per cent of the vertices
};

/// A case that is ready to run; its functions own what they need.
struct ReadyCase {
    size_t vertices = 0; ///< of the mesh
    size_t region = 0;   ///< of them, those that the work is about
    uint64_t bytes = 0;  ///< that have to be read or written at least once
    std::function<void()> work;
    std::vector<Yardstick> yardsticks;
    std::optional<StepError> error;
};

/// A case that is prepared only when it is its turn. The name has no spaces; its parts are joined by '/'.
struct BenchCase {
    std::string name;
    std::function<ReadyCase()> prepare;
};

struct BenchResult {
    std::string name;
    size_t vertices = 0;
    size_t region = 0;
    Timing timing;
    uint64_t bytes = 0;
    uint64_t device_bytes = 0; ///< of the device's memory that the case holds, its yardsticks on it included
    std::vector<std::pair<std::string, double>> ratios; ///< by yardstick: median over the yardstick's median
    std::optional<StepError> error;
};

/// `device_memory`: bytes of it in use now.
BenchResult run_case(const BenchCase& bench, const SamplingEffort& effort,
                     const std::function<uint64_t()>& device_memory);

} // namespace anvil
