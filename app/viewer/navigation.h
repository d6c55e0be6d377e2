// Mouse buttons and the wheel that move the camera.
#pragma once

#include "app/viewer/input_event.h"
#include "app/viewer/orbit_camera.h"

#include <optional>

namespace anvil {

/// Whose habits the mouse follows. Blender: middle button turns, with Shift moves, with Control zooms. Maya:
/// with Alt, the left button turns, the middle moves, the right zooms. Alt works so in both.
enum class MousePreset : uint8_t { blender, maya };

class Navigation {
  public:
    MousePreset preset = MousePreset::blender;

    /// Whether the event was the camera's. `under_cursor`: the surface there, which a turn turns about.
    bool handle(const InputEvent& event, OrbitCamera& camera, const std::optional<Vec3>& under_cursor);
    bool active() const { return mode_ != Mode::none; }
    /// Of the last event that moved the camera: steps of the wheel, as factors.
    static double wheel_factor(double steps);

  private:
    enum class Mode : uint8_t { none, turn, pan, zoom };

    Mode mode_of(const InputEvent& press) const;

    Mode mode_ = Mode::none;
    MouseButton button_ = MouseButton::left;
    double x_ = 0;
    double y_ = 0;
    double start_x_ = 0;
    double start_y_ = 0;
};

} // namespace anvil
