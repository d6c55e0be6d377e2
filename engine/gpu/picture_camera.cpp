#include "engine/gpu/surface_vertices.h"

#include <glm/gtc/matrix_transform.hpp>

namespace anvil {

namespace {

constexpr double field_of_view = 0.5236; // 30 degrees: little distortion, still some depth

/// Calls visit(p) with every finite position turned into view directions, relative to `centre`.
template <class Visit>
void each_point(std::span<const PictureSurface> surfaces, const glm::dmat3& turn, const Vec3& centre,
                const Visit& visit) {
    for (const PictureSurface& surface : surfaces) {
        for (const glm::vec3& position : surface.positions) {
            if (is_finite(Vec3(position))) {
                visit(turn * (Vec3(position) - centre));
            }
        }
    }
}

/// Eye of a perspective picture, relative to the centre and in view directions: as near as all points allow.
/// A point (x, y, z) fits where x <= eye.x + (eye.z - z) tan_x and so on, hence the least sums and
/// differences.
Vec3 nearest_eye(std::span<const PictureSurface> surfaces, const glm::dmat3& turn, const Vec3& centre,
                 double tan_x, double tan_y) {
    Vec3 most_high{-infinity};
    Vec3 most_low{-infinity};
    each_point(surfaces, turn, centre, [&](const Vec3& p) {
        most_high = glm::max(most_high, Vec3(p.x / tan_x + p.z, p.y / tan_y + p.z, 0));
        most_low = glm::max(most_low, Vec3(-p.x / tan_x + p.z, -p.y / tan_y + p.z, 0));
    });
    const double distance_x = (most_high.x + most_low.x) / 2;
    const double distance_y = (most_high.y + most_low.y) / 2;
    return {tan_x * (most_high.x - most_low.x) / 2, tan_y * (most_high.y - most_low.y) / 2,
            std::max(distance_x, distance_y)};
}

} // namespace

PictureCamera frame_surfaces(std::span<const PictureSurface> surfaces, const PictureView& view,
                             double aspect) {
    const Vec3 back = glm::normalize(view.direction);
    const Vec3 up = std::abs(back.y) > 0.999 ? Vec3(0, 0, back.y > 0 ? -1 : 1) : Vec3(0, 1, 0);
    const auto turn = glm::dmat3(glm::lookAt(Vec3(0), -back, up));
    Box box;
    Box turned;
    for (const PictureSurface& surface : surfaces) {
        const Box part = bounds(surface);
        if (!part.empty()) {
            box.include(part.low);
            box.include(part.high);
        }
    }
    const Vec3 centre = box.centre();
    each_point(surfaces, turn, centre, [&](const Vec3& p) { turned.include(p); });
    const double room = 1 - 2 * std::clamp(view.margin, 0.0, 0.4);
    const double size = std::max(turned.diagonal(), 1e-30);
    const double tan_y = std::tan(field_of_view / 2) * std::min(1.0, 1 / aspect);
    Vec3 eye = Vec3(turned.centre().x, turned.centre().y, turned.high.z + size);
    if (!view.orthographic) {
        eye = nearest_eye(surfaces, turn, centre, tan_y * aspect * room, tan_y * room);
        eye.z = std::max(eye.z, turned.high.z + 0.01 * size);
    }
    const double near = (eye.z - turned.high.z) * 0.98;
    const double far = (eye.z - turned.low.z) * 1.02;
    const Vec3 extent = turned.high - turned.low;
    const double half_height = std::max({extent.y, extent.x / aspect, 1e-6 * size}) / 2 / room;
    PictureCamera camera;
    glm::dmat4 projection = view.orthographic
                                ? glm::orthoRH_ZO(-half_height * aspect, half_height * aspect, -half_height,
                                                  half_height, near, far)
                                : glm::perspectiveRH_ZO(2 * std::atan(tan_y), aspect, near, far);
    for (int column = 0; column < 4; ++column) {
        projection[column][1] *= -1; // Vulkan's y points down
    }
    camera.projection = projection;
    camera.view =
        glm::translate(glm::dmat4(1), -eye) * glm::dmat4(turn) * glm::translate(glm::dmat4(1), -centre);
    return camera;
}

} // namespace anvil
