#include "app/viewer/event_queue.h"

#include <algorithm>

namespace anvil {

namespace {

using Kind = InputEvent::Kind;

constexpr int first_without_letter = 256; ///< of GLFW's keys

bool is_button(const InputEvent& event) {
    return event.kind == Kind::press || event.kind == Kind::release;
}

bool is_key(const InputEvent& event) {
    return event.kind == Kind::key_down || event.kind == Kind::key_up;
}

/// Whether a frame that has seen `before` cannot see `event`.
bool hides(const InputEvent& before, const InputEvent& event) {
    if (is_button(before)) {
        return event.kind == Kind::move || (is_button(event) && event.button == before.button);
    }
    if (is_key(before) && is_key(event)) { // a key that repeats is no change
        return event.key == before.key && event.kind != before.kind;
    }
    return before.kind == Kind::text && event.kind == Kind::key_down && event.key >= first_without_letter;
}

} // namespace

void EventQueue::add(const std::vector<InputEvent>& events) {
    waiting_.insert(waiting_.end(), events.begin(), events.end());
}

std::vector<InputEvent> EventQueue::take_frame() {
    std::vector<InputEvent> frame;
    while (!waiting_.empty() && std::none_of(frame.begin(), frame.end(), [&](const InputEvent& before) {
        return hides(before, waiting_.front());
    })) {
        frame.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
    }
    return frame;
}

} // namespace anvil
