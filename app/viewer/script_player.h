// Plays a script to a session, some of it each frame, as a person would.
#pragma once

#include "app/viewer/frame_log.h"
#include "app/viewer/script.h"
#include "app/viewer/session.h"
#include "app/viewer/window.h"

#include <chrono>
#include <deque>

namespace anvil {

/// What a script takes from the window, as if it failed.
enum class Loss : uint8_t { none, drawing, surface };

class ScriptPlayer {
  public:
    /// @throws InputError as read_script()
    explicit ScriptPlayer(const std::filesystem::path& file);

    /// What a person would do next, before a frame. Pictures that are wanted of the frame follow.
    /// @throws InputError naming the line: a place that is not there, an expectation that does not hold.
    std::vector<InputEvent> next(Session& session, Window& window, FrameLog& frames);
    /// Files to write the frame to that is drawn now.
    std::vector<std::string> take_pictures() { return std::exchange(pictures_, {}); }
    bool wants_picture() const { return !pictures_.empty(); }
    /// What is to fail now.
    Loss take_loss() { return std::exchange(loses_, Loss::none); }
    /// A person would go on at once: nobody looks at this frame for long.
    bool busy() const { return !events_.empty() || (!waiting_ && pictures_.empty() && !done()); }
    /// Waits for the session or the clock, not for the next frame.
    bool resting() const { return events_.empty() && (waiting_ || FrameLog::Clock::now() < awake_at_); }
    /// All lines are played and their frames drawn.
    bool done() const { return next_ == lines_.size() && events_.empty() && !waiting_; }

  private:
    bool play(const ScriptLine& line, Session& session, Window& window, FrameLog& frames);
    void act(const ScriptLine& line, Session& session, Window& window, FrameLog& frames);
    void expect(const ScriptLine& line, Session& session) const;
    void add_mouse(InputEvent::Kind kind, const std::vector<std::string>& arguments);
    void add_move(double x, double y);
    void add_drag(const ScriptLine& line);
    void move_to(const ScriptLine& line, const Session& session);

    std::string file_;
    std::vector<ScriptLine> lines_;
    size_t next_ = 0;
    std::deque<InputEvent> events_; ///< one a frame
    Modifiers held_;
    double x_ = 0;
    double y_ = 0;
    bool waiting_ = false;
    int settled_frames_ = 0;
    Loss loses_ = Loss::none;
    std::chrono::steady_clock::time_point awake_at_{};
    std::vector<std::string> pictures_;
};

} // namespace anvil
