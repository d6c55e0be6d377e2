#include "app/viewer/marks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace anvil {

namespace {

/// Marks lie on the surface, which floats and pixels put a little before or behind them.
constexpr double nearer_pixels = 3;

} // namespace

std::optional<glm::vec3> Marks::seen(const Vec3& place) const {
    const ScreenPoint at = camera_.project(place);
    if (!at.visible()) {
        return std::nullopt;
    }
    const double away = at.depth - nearer_pixels * camera_.pixel_size(at.depth);
    const glm::dmat4 projection(scene_.projection);
    const double clip = projection[3][2] - projection[2][2] * away;
    const double w = projection[3][3] - projection[2][3] * away;
    const double depth = w > 0 ? std::clamp(clip / w, 0.0, 1.0) : 0.0; // nothing is nearer than the eye
    return glm::vec3(at.x, at.y, depth);
}

void Marks::add(uint32_t kind, Colour colour, glm::vec4 a, glm::vec4 b, const glm::vec4& c) {
    a.w *= static_cast<float>(camera_.unit);
    b.w *= static_cast<float>(camera_.unit);
    all_.push_back({a, b, c, colour, kind, 0, 0});
}

void Marks::disc(const Vec3& place, double radius, Colour colour) {
    line(place, place, 2 * radius, colour);
}

void Marks::ring(const Vec3& place, double radius, double width, Colour colour) {
    if (const auto at = seen(place)) {
        add(MARK_RING, colour, glm::vec4(*at, radius), glm::vec4(0, 0, 0, width / 2));
    }
}

void Marks::square(const Vec3& place, double half, Colour colour) {
    if (const auto at = seen(place)) {
        add(MARK_SQUARE, colour, glm::vec4(*at, half));
    }
}

void Marks::line(const Vec3& a, const Vec3& b, double width, Colour colour) {
    const auto from = seen(a);
    const auto to = seen(b);
    if (from && to) {
        add(MARK_LINE, colour, glm::vec4(*from, width / 2), glm::vec4(*to, 0));
    }
}

void Marks::facet(const Vec3& a, const Vec3& b, const Vec3& c, Colour colour) {
    const std::array corners{seen(a), seen(b), seen(c)};
    if (corners[0] && corners[1] && corners[2]) {
        add(MARK_FACET, colour, glm::vec4(*corners[0], 0), glm::vec4(*corners[1], 0),
            glm::vec4(*corners[2], 0));
    }
}

void Marks::triangle(const Vec3& place, double radius, double width, Colour colour) {
    const auto at = seen(place);
    if (!at) {
        return;
    }
    const auto corner = [&](double angle) {
        const glm::dvec2 away = camera_.unit * radius * glm::dvec2(std::cos(angle), std::sin(angle));
        return glm::vec4(at->x + away.x, at->y + away.y, at->z, width / 2);
    };
    constexpr double third = 2.0943951023931953;
    for (int i = 0; i < 3; ++i) {
        add(MARK_LINE, colour, corner(i * third), glm::vec4(glm::vec3(corner((i + 1) * third)), 0));
    }
}

} // namespace anvil
