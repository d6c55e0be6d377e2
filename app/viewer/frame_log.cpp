#include "app/viewer/frame_log.h"

#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace anvil {

namespace {

double processor_seconds() {
    std::timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string tenths(double value) {
    return rounded_text(std::round(value * 10) / 10);
}

} // namespace

void FrameLog::frame(Clock::time_point now) {
    if (begun_ != Clock::time_point{}) {
        milliseconds_.push_back(std::chrono::duration<double, std::milli>(now - begun_).count());
    }
    begun_ = now;
}

std::string FrameLog::report() {
    const double processor = processor_seconds();
    std::string text = std::to_string(milliseconds_.size()) + " frames";
    if (!milliseconds_.empty()) {
        std::sort(milliseconds_.begin(), milliseconds_.end());
        const auto count = static_cast<double>(milliseconds_.size());
        text += ", median " + tenths(milliseconds_[milliseconds_.size() / 2]) + " ms, longest " +
                tenths(milliseconds_.back()) + " ms, processor " +
                tenths(1000 * (processor - processor_seconds_) / count) + " ms";
    }
    milliseconds_.clear();
    processor_seconds_ = processor;
    return text;
}

} // namespace anvil
