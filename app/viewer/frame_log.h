// How long the window takes from frame to frame, for scripts that measure.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace anvil {

class FrameLog {
  public:
    using Clock = std::chrono::steady_clock;

    /// Another frame begins. It ends the one before.
    void frame(Clock::time_point now = Clock::now());
    /// What happened since the last report: how many frames, how long the middle one took and the longest,
    /// which is how long the window stood still at most, and the processor time of all threads a frame.
    std::string report();

  private:
    std::vector<double> milliseconds_;
    Clock::time_point begun_{};
    double processor_seconds_ = 0; ///< of the process, at the last report
};

} // namespace anvil
