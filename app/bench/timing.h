// How long pieces of work take beside each other.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace anvil {

/// What seconds are read from: the clock on the wall, or the time that all threads of this program computed.
enum class BenchClock { wall, processor };

/// Seconds of one piece of work.
struct Timing {
    size_t samples = 0;
    double median_s = 0;
    double min_s = 0;
    double max_s = 0;
};

/// When sampling ends: at `most` samples, or at `seconds` once there are `least`.
struct SamplingEffort {
    size_t least = 3;
    size_t most = 25;
    double seconds = 3;
    double long_s = 2; ///< what beside the first work takes longer is run once
    BenchClock clock = BenchClock::wall;
};

/// Runs each work once (caches, compilation), then all in turn, round by round, so that what else the machine
/// does meets all alike. One entry per work, equally many samples each, but one where the first run of
/// another than the first work was a long one: that run is its sample.
std::vector<Timing> measure_together(std::span<const std::function<void()>> works,
                                     const SamplingEffort& effort);

} // namespace anvil
