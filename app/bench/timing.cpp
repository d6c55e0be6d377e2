#include "app/bench/timing.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace anvil {

namespace {

double seconds_now(BenchClock clock) {
    if (clock == BenchClock::processor) {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds_of(const std::function<void()>& work, BenchClock clock) {
    const double start = seconds_now(clock);
    work();
    return seconds_now(clock) - start;
}

/// The mean of the middle two where their number is even.
Timing summary_of(std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    const size_t n = seconds.size();
    return {n, 0.5 * (seconds[(n - 1) / 2] + seconds[n / 2]), seconds.front(), seconds.back()};
}

} // namespace

std::vector<Timing> measure_together(std::span<const std::function<void()>> works,
                                     const SamplingEffort& effort) {
    std::vector<std::vector<double>> seconds(works.size());
    std::vector<size_t> again;
    for (size_t i = 0; i < works.size(); ++i) {
        const double first = seconds_of(works[i], effort.clock);
        if (i > 0 && first > effort.long_s) {
            seconds[i].push_back(first);
        } else {
            again.push_back(i);
        }
    }
    double spent = 0;
    for (size_t round = 0; round < effort.most && (round < effort.least || spent < effort.seconds); ++round) {
        for (const size_t i : again) {
            seconds[i].push_back(seconds_of(works[i], effort.clock));
            spent += seconds[i].back();
        }
    }
    std::vector<Timing> timings;
    timings.reserve(works.size());
    for (std::vector<double>& of_work : seconds) {
        timings.push_back(summary_of(std::move(of_work)));
    }
    return timings;
}

} // namespace anvil
