#include "app/viewer/navigation.h"

namespace anvil {

namespace {

constexpr double wheel_step = 1.15;
constexpr double zoom_a_pixel = 1.006;

} // namespace

double Navigation::wheel_factor(double steps) {
    return std::pow(wheel_step, std::clamp(steps, -20.0, 20.0));
}

Navigation::Mode Navigation::mode_of(const InputEvent& press) const {
    if (press.modifiers.alt) {
        return press.button == MouseButton::left     ? Mode::turn
               : press.button == MouseButton::middle ? Mode::pan
                                                     : Mode::zoom;
    }
    if (press.button != MouseButton::middle || preset == MousePreset::maya) {
        return Mode::none;
    }
    return press.modifiers.shift ? Mode::pan : press.modifiers.control ? Mode::zoom : Mode::turn;
}

bool Navigation::handle(const InputEvent& event, OrbitCamera& camera,
                        const std::optional<Vec3>& under_cursor) {
    switch (event.kind) {
    case InputEvent::Kind::press:
        if (mode_ == Mode::none && mode_of(event) != Mode::none) {
            mode_ = mode_of(event);
            button_ = event.button;
            start_x_ = x_;
            start_y_ = y_;
            if (mode_ == Mode::turn && under_cursor) {
                camera.set_pivot(*under_cursor);
            }
            return true;
        }
        return mode_ != Mode::none;
    case InputEvent::Kind::release:
        if (mode_ != Mode::none && event.button == button_) {
            mode_ = Mode::none;
            return true;
        }
        return false;
    case InputEvent::Kind::move: {
        const double dx = event.x - x_;
        const double dy = event.y - y_;
        x_ = event.x;
        y_ = event.y;
        if (mode_ == Mode::turn) {
            camera.turn(dx, dy);
        } else if (mode_ == Mode::pan) {
            camera.pan(dx, dy);
        } else if (mode_ == Mode::zoom) {
            camera.zoom(std::pow(zoom_a_pixel, dx - dy), start_x_, start_y_);
        }
        return mode_ != Mode::none;
    }
    case InputEvent::Kind::scroll:
        camera.zoom(wheel_factor(event.y), x_, y_);
        return true;
    default:
        return false;
    }
}

} // namespace anvil
