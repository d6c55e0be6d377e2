#include "app/viewer/select_tool.h"

#include "app/viewer/window.h"

#include <cmath>
#include <utility>

namespace anvil {

namespace {

constexpr double still_pixels = 3; ///< a press that moves less is a click
constexpr double lasso_pixels = 2; ///< between the lasso's points

double apart(const Cursor& a, const Cursor& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace

bool SelectTool::handle(const InputEvent& event, const OrbitCamera& camera) {
    switch (event.kind) {
    case InputEvent::Kind::move:
        cursor_ = {event.x, event.y};
        if (outline_.empty()) {
            return false;
        }
        extend(cursor_);
        return true;
    case InputEvent::Kind::press:
        if (event.button == MouseButton::left && !event.modifiers.alt && outline_.empty()) {
            mode_ = event.modifiers.control ? SelectMode::subtract
                    : event.modifiers.shift ? SelectMode::add
                                            : SelectMode::replace;
            outline_ = {cursor_};
            return true;
        }
        return !outline_.empty();
    case InputEvent::Kind::release:
        if (event.button == MouseButton::left && !outline_.empty()) {
            finish(camera);
            return true;
        }
        return false;
    case InputEvent::Kind::key_down:
        if (event.key == key_of("escape") && !outline_.empty()) {
            outline_.clear();
            return true;
        }
        return !outline_.empty();
    default:
        return false;
    }
}

void SelectTool::extend(const Cursor& to) {
    const Cursor from = outline_.front();
    if (!lasso) {
        outline_ = {from, {to.x, from.y}, to, {from.x, to.y}};
    } else if (apart(outline_.back(), to) >= lasso_pixels) {
        outline_.push_back(to);
    }
}

void SelectTool::finish(const OrbitCamera& camera) {
    double reach = 0;
    for (const Cursor& point : outline_) {
        reach = std::max(reach, apart(point, outline_.front()));
    }
    SelectionChange change;
    change.mode = mode_;
    change.through = through;
    change.camera = camera;
    change.outline = std::exchange(outline_, {});
    if (reach <= still_pixels) {
        change.outline = {cursor_};
    }
    asked_ = std::move(change);
}

std::optional<SelectionChange> SelectTool::take() {
    return std::exchange(asked_, std::nullopt);
}

std::optional<SelectionChange::Kind> selection_key(const InputEvent& event) {
    using Kind = SelectionChange::Kind;
    const Modifiers& held = event.modifiers;
    if (held.control && !held.alt) {
        if (event.key == 'A') {
            return held.shift ? Kind::none : Kind::all;
        }
        return event.key == 'I' ? std::optional(Kind::invert) : std::nullopt;
    }
    if (event.key == 'H') {
        return held.alt ? Kind::show_all : held.shift ? Kind::hide_unselected : Kind::hide_selected;
    }
    if (held.alt) {
        return std::nullopt;
    }
    if (event.key == key_of("plus") || event.key == key_of("equal")) {
        return Kind::grow;
    }
    return event.key == key_of("minus") ? std::optional(Kind::shrink) : std::nullopt;
}

} // namespace anvil
