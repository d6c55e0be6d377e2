#include "app/cli/progress_bar.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <unistd.h>

namespace anvil {

namespace {

bool drawn = false;

} // namespace

Progress::Listener progress_bar() {
    if (isatty(STDERR_FILENO) == 0) {
        return {};
    }
    using Clock = std::chrono::steady_clock;
    return [last = Clock::time_point(), shown = std::string()](const std::string& stage,
                                                               double fraction) mutable {
        const auto now = Clock::now();
        if (stage == shown && now - last < std::chrono::milliseconds(100)) {
            return;
        }
        last = now;
        shown = stage;
        constexpr size_t width = 30;
        const double done = std::clamp(fraction, 0.0, 1.0);
        const auto filled = static_cast<size_t>(done * width);
        std::cerr << "\r\033[K[" << std::string(filled, '#') << std::string(width - filled, ' ') << "] "
                  << static_cast<int>(done * 100) << " % " << stage << std::flush;
        drawn = true;
    };
}

void clear_progress_bar() {
    if (drawn) {
        std::cerr << "\r\033[K" << std::flush;
        drawn = false;
    }
}

} // namespace anvil
