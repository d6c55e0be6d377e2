#include "app/bench/bench_case.h"

namespace anvil {

BenchResult run_case(const BenchCase& bench, const SamplingEffort& effort,
                     const std::function<uint64_t()>& device_memory) {
    const uint64_t before = device_memory();
    const ReadyCase ready = bench.prepare();
    std::vector<std::function<void()>> works{ready.work};
    for (const Yardstick& yardstick : ready.yardsticks) {
        works.push_back(yardstick.work);
    }
    const std::vector<Timing> timings = measure_together(works, effort);
    BenchResult result{bench.name,  ready.vertices,           ready.region, timings[0],
                       ready.bytes, device_memory() - before, {},           ready.error};
    for (size_t i = 0; i < ready.yardsticks.size(); ++i) {
        result.ratios.emplace_back(ready.yardsticks[i].name, timings[0].median_s / timings[i + 1].median_s);
    }
    return result;
}

} // namespace anvil
