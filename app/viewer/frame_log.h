// How long the window takes from frame to frame, and at what, for scripts that measure.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace anvil {

/// What the thread of the window is at.
enum class FramePart : uint8_t {
    idle,      ///< waits for something to happen; no part of the frame's time
    events,    ///< takes and handles them
    session,   ///< takes up what the worker has made
    panels,    ///< lays them out
    device,    ///< waits for the frame before
    image,     ///< waits for an image of the window
    preparing, ///< pipelines and buffers for the frame
    recording, ///< commands
    submitting,
    showing,
    pictures, ///< writes files
    count
};

/// What was drawn.
enum class FrameKind : uint8_t { panels, whole_surface, part_of_surface, count };

class FrameLog {
  public:
    using Clock = std::chrono::steady_clock;

    /// Another frame begins, with events. It ends the one before.
    void frame(Clock::time_point now = Clock::now());
    /// What the frame goes on with. What it was at before has ended.
    void enter(FramePart part, Clock::time_point now = Clock::now());
    /// What the frame draws; panels alone, unless this is said.
    void draws(FrameKind kind) { current_.kind = kind; }

    /// What happened since the last report: how many frames, and the processor time of all threads a frame;
    /// then for each kind of frame, a line each, how many, the middle one, that which 95 % are no longer
    /// than, and the longest, which is how long the window stood still at most, with what it was at, and the
    /// processor time of the window's thread alone: the rest it waited, or others had its processor.
    std::string report();

  private:
    struct Frame {
        FrameKind kind = FrameKind::panels;
        std::array<double, static_cast<size_t>(FramePart::count)> parts{}; ///< milliseconds
        double own = 0; ///< milliseconds of processor time of the thread

        double milliseconds() const;
    };

    static std::string describe(std::vector<Frame> frames);
    static std::string parts_of(const Frame& frame);

    std::vector<Frame> frames_;
    Frame current_;
    FramePart part_ = FramePart::idle;
    Clock::time_point entered_{};  ///< the part; none: no frame has begun
    double own_seconds_ = 0;       ///< processor time of the thread, when the frame began
    double processor_seconds_ = 0; ///< of the process, at the last report
};

} // namespace anvil
