#include "app/viewer/orbit_camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace anvil {

namespace {

constexpr double radians_a_window = 3.14159265358979; // a drag over the shorter side turns by half a turn
constexpr double frame_margin = 1.08;

/// The rotation from view to world that looks along -direction with `up` towards the top.
glm::dquat looking_from(const Vec3& direction, const Vec3& up) {
    const Vec3 back = glm::normalize(direction);
    Vec3 side = glm::cross(up, back);
    if (glm::length(side) < 1e-6) { // from above or below: the top of the window is away from the front
        const Vec3 front = up.y > 0.5 ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
        side = glm::cross(glm::dot(up, back) > 0 ? -front : front, back);
    }
    side = glm::normalize(side);
    return glm::normalize(glm::quat_cast(glm::dmat3(side, glm::cross(back, side), back)));
}

} // namespace

void OrbitCamera::set_window(double width, double height) {
    width_ = std::max(width, 1.0);
    height_ = std::max(height, 1.0);
}

void OrbitCamera::set_up(UpAxis up) {
    if (up == up_) {
        return;
    }
    const double quarter = up == UpAxis::z ? glm::half_pi<double>() : -glm::half_pi<double>();
    rotation_ = glm::normalize(glm::angleAxis(quarter, Vec3(1, 0, 0)) * rotation_);
    up_ = up;
}

Vec3 OrbitCamera::side(const Vec3& direction) const {
    return up_ == UpAxis::y ? direction : Vec3(direction.x, -direction.z, direction.y);
}

double OrbitCamera::half_height() const {
    const double shorter = std::tan(field_of_view / 2);
    return width_ >= height_ ? shorter : shorter * height_ / width_;
}

void OrbitCamera::frame(std::span<const Vec3> points, const std::optional<Vec3>& direction) {
    if (direction) {
        rotation_ = looking_from(*direction, up_axis());
    }
    Box box;
    for (const Vec3& p : points) {
        if (is_finite(p)) {
            box.include(p);
        }
    }
    shift_ = glm::dvec2(0);
    if (box.empty()) {
        return;
    }
    pivot_ = box.centre();
    const glm::dmat3 to_view = glm::transpose(glm::mat3_cast(rotation_));
    const double tangent_y = half_height() / frame_margin;
    const double tangent_x = tangent_y * width_ / height_;
    double needed = 1e-6 * std::max(box.diagonal(), 1e-30);
    for (const Vec3& p : points) {
        if (is_finite(p)) {
            const Vec3 v = to_view * (p - pivot_);
            const double across = std::max(std::abs(v.x) / tangent_x, std::abs(v.y) / tangent_y);
            needed = std::max(needed, across + (orthographic ? 0.0 : v.z));
        }
    }
    distance_ = needed;
}

void OrbitCamera::look_from(const Vec3& direction) {
    rotation_ = looking_from(direction, up_axis());
    shift_ = glm::dvec2(0);
}

void OrbitCamera::turn(double dx, double dy) {
    const double scale = radians_a_window / std::min(width_, height_);
    if (trackball) {
        const glm::dvec2 drag(dx * scale, dy * scale);
        const double angle = glm::length(drag);
        if (angle > 0) {
            rotation_ = rotation_ * glm::angleAxis(-angle, Vec3(drag.y / angle, drag.x / angle, 0));
        }
    } else {
        // Upside down, a drag to the right still turns what is in front to the right.
        const double side = glm::dot(up(), up_axis()) < 0 ? -1 : 1;
        rotation_ = glm::angleAxis(-dx * scale * side, up_axis()) * rotation_ *
                    glm::angleAxis(-dy * scale, Vec3(1, 0, 0));
    }
    rotation_ = glm::normalize(rotation_);
}

void OrbitCamera::roll(double radians) {
    rotation_ = glm::normalize(rotation_ * glm::angleAxis(radians, Vec3(0, 0, 1)));
}

double OrbitCamera::pixel_size(double depth) const {
    return 2 * half_height() * (orthographic ? distance_ : depth) / height_;
}

void OrbitCamera::pan(double dx, double dy) {
    shift_ += glm::dvec2(dx, -dy) * pixel_size(distance_);
}

void OrbitCamera::zoom(double factor, double x, double y) {
    const glm::dvec2 cursor = glm::dvec2(x - width_ / 2, height_ / 2 - y) * pixel_size(distance_);
    distance_ /= factor;
    shift_ += cursor / factor - cursor; // a pixel at the pivot's depth is shorter by the factor
}

void OrbitCamera::set_pivot(const Vec3& pivot) {
    const glm::dmat3 to_view = glm::transpose(glm::mat3_cast(rotation_));
    const Vec3 seen = to_view * (pivot - eye());
    if (seen.z > -1e-9 * distance_) {
        return; // behind the eye
    }
    pivot_ = pivot;
    shift_ = glm::dvec2(seen);
    if (!orthographic) {
        distance_ = -seen.z;
    }
}

Vec3 OrbitCamera::forward() const {
    return rotation_ * Vec3(0, 0, -1);
}

Vec3 OrbitCamera::right() const {
    return rotation_ * Vec3(1, 0, 0);
}

Vec3 OrbitCamera::up() const {
    return rotation_ * Vec3(0, 1, 0);
}

Vec3 OrbitCamera::eye() const {
    return pivot_ - rotation_ * Vec3(shift_, -distance_);
}

Ray OrbitCamera::ray(double x, double y) const {
    const glm::dvec2 across = glm::dvec2(2 * x / width_ - 1, 1 - 2 * y / height_) *
                              (half_height() * glm::dvec2(width_ / height_, 1));
    if (orthographic) {
        return {eye() + rotation_ * Vec3(across * distance_, 0), forward()};
    }
    return {eye(), glm::normalize(rotation_ * Vec3(across, -1))};
}

ScreenPoint OrbitCamera::project(const Vec3& point) const {
    const Vec3 v = glm::conjugate(rotation_) * (point - eye());
    const double depth = -v.z;
    const double pixel = pixel_size(depth);
    if (!(pixel > 0)) {
        return {0, 0, depth};
    }
    return {width_ / 2 + v.x / pixel, height_ / 2 - v.y / pixel,
            orthographic ? std::max(depth, 1e-30) : depth};
}

glm::mat4 OrbitCamera::view(const Vec3& origin) const {
    const glm::dmat4 turn = glm::mat4_cast(glm::conjugate(rotation_));
    return turn * glm::translate(glm::dmat4(1), origin - eye());
}

glm::mat4 OrbitCamera::projection(const Box& scene) const {
    const double reach = glm::length(scene.centre() - eye()) + 0.5 * scene.diagonal();
    const double depth = glm::dot(scene.centre() - eye(), forward());
    const double half = 0.5 * scene.diagonal();
    const double far = std::max(depth + half, 1e-3 * reach) * 1.01;
    const double aspect = width_ / height_;
    glm::dmat4 projection;
    if (orthographic) {
        const double tall = half_height() * distance_;
        projection = glm::orthoRH_ZO(-tall * aspect, tall * aspect, -tall, tall, depth - half * 1.01, far);
    } else {
        const double near = std::max(depth - half, 1e-4 * far) * 0.99;
        projection = glm::perspectiveRH_ZO(2 * std::atan(half_height()), aspect, near, far);
    }
    for (int column = 0; column < 4; ++column) {
        projection[column][1] *= -1; // Vulkan's y points down
    }
    return projection;
}

} // namespace anvil
