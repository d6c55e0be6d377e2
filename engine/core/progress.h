// A token that long stages take: it hears how far they are and can stop them.
#pragma once

#include "engine/core/error.h"

#include <atomic>
#include <functional>
#include <string>
#include <utility>

namespace anvil {

/// Thread-safe in cancel() only; stages report from one thread.
class Progress {
  public:
    using Listener = std::function<void(const std::string& stage, double fraction)>;

    Progress() = default;
    explicit Progress(Listener listener) : listener_(std::move(listener)) {}

    void cancel() { cancelled_ = true; }

    /// `fraction` in [0, 1] of the named stage. @throws Cancelled after cancel().
    void report(const std::string& stage, double fraction) {
        if (cancelled_) {
            throw Cancelled();
        }
        if (listener_) {
            listener_(stage, fraction);
        }
    }

  private:
    Listener listener_;
    std::atomic<bool> cancelled_{false};
};

} // namespace anvil
