// Where the viewer looks from: turns about a point, moves, zooms to the cursor.
#pragma once

#include "engine/core/types.h"

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>

namespace anvil {

enum class UpAxis : uint8_t { y, z };

/// A half line, direction of unit length.
struct Ray {
    Vec3 origin{0};
    Vec3 direction{0, 0, -1};
};

/// A place in the window: pixels from the left and the top, and how far in front of the eye (world).
struct ScreenPoint {
    double x = 0;
    double y = 0;
    double depth = 0;

    bool visible() const { return depth > 0; }
};

class OrbitCamera {
  public:
    bool orthographic = false;
    bool trackball = false;      ///< turn() rolls freely; else `up` stays upright: a turntable
    double field_of_view = 0.61; ///< of the window's shorter side, radians
    double unit = 1; ///< pixels of what is one on a display of 96 dots an inch: how large marks are

    void set_window(double width, double height);
    void set_up(UpAxis up); ///< turns the eye along: what was front stays front
    UpAxis upright() const { return up_; }
    /// What `direction` of a scene whose y points up is in one with this camera's up: front, right, top.
    Vec3 side(const Vec3& direction) const;

    /// Looks along -direction (any length > 0) from where the window shows all points; `centre` is then what
    /// the camera turns about. No points: keeps the distance.
    void frame(std::span<const Vec3> points, const std::optional<Vec3>& direction = std::nullopt);
    /// Looks from that side of the pivot, as far away as before.
    void look_from(const Vec3& direction);

    /// By a drag of so many pixels.
    void turn(double dx, double dy);
    void roll(double radians);
    void pan(double dx, double dy);
    /// Nearer by the factor > 1; what is at (x, y) stays there.
    void zoom(double factor, double x, double y);
    /// What turn() turns about from here on; the picture stays.
    void set_pivot(const Vec3& pivot);

    Vec3 eye() const;
    Vec3 forward() const;
    Vec3 right() const;
    Vec3 up() const;
    const Vec3& pivot() const { return pivot_; }
    double distance() const { return distance_; }
    Ray ray(double x, double y) const;
    ScreenPoint project(const Vec3& point) const;
    /// World length of a pixel at a depth in front of the eye.
    double pixel_size(double depth) const;

    /// World to view space, relative to `origin` for float's sake.
    glm::mat4 view(const Vec3& origin) const;
    /// For Vulkan (y down, depth 0..1), near and far around `scene`.
    glm::mat4 projection(const Box& scene) const;

  private:
    double half_height() const; ///< tangent of half the vertical angle of view
    Vec3 up_axis() const { return up_ == UpAxis::y ? Vec3(0, 1, 0) : Vec3(0, 0, 1); }

    double width_ = 1280;
    double height_ = 800;
    UpAxis up_ = UpAxis::y;
    Vec3 pivot_{0};
    glm::dvec2 shift_{0};             ///< of the pivot in the window's plane at its depth, world
    double distance_ = 3;             ///< from the eye's plane to the pivot
    glm::dquat rotation_{1, 0, 0, 0}; ///< view to world
};

} // namespace anvil
