// Lines along the surface: drawn by clicks, traced beside the window.
#include "app/viewer/session.h"

namespace anvil {

bool Session::handle_line(const InputEvent& event) {
    const bool is_move =
        event.kind == InputEvent::Kind::move; // the tool knows the cursor before its first press
    if (editor.tool == Tool::line || is_move) {
        const bool taken = line.handle(event, camera, shown_->pick.get());
        if (const auto finished = line.take()) {
            editor.add_line(finished->line, finished->further);
            editor.tool = Tool::move; // what was drawn is moved next
        }
        return taken;
    }
    const bool wanted =
        event.kind == InputEvent::Kind::key_down && event.key == 'L' && event.modifiers == Modifiers{};
    if (wanted) {
        editor.tool = Tool::line;
    }
    return wanted;
}

void Session::trace_line() {
    {
        const std::lock_guard lock(mutex_);
        if (traced_) {
            line.set_path(traced_->addresses(), traced_->path);
            editor.set_path(traced_->addresses(), traced_->path);
            traced_.reset();
        }
    }
    const std::vector<SurfaceAddress> points = line.line().addresses();
    if (points.size() < 2 || points == asked_for_) {
        return;
    }
    asked_for_ = points;
    ask(
        "tracing a line",
        [this, drawn = line.line(), points](Progress&) mutable {
            drawn.path = bench_->trace(points);
            const std::lock_guard lock(mutex_);
            traced_ = std::move(drawn);
        },
        "line");
}

} // namespace anvil
