#include "engine/mesh/smooth_body.h"

#include <numbers>

namespace anvil {

namespace {

FieldValue negated(const FieldValue& f) {
    return {-f.value, -f.gradient};
}

FieldValue smooth_min(const FieldValue& a, const FieldValue& b, double width) {
    const FieldValue& low = a.value < b.value ? a : b;
    const FieldValue& high = a.value < b.value ? b : a;
    if (!(high.value - low.value < width)) {
        return low;
    }
    const double h = 1 - (high.value - low.value) / width;
    const double share = 0.5 * h * h; // of the higher one in the gradient
    return {low.value - h * h * h * width / 6, (1 - share) * low.gradient + share * high.gradient};
}

glm::dmat3 rotation(const Vec3& axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return axis.x > 0 ? glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c) : glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
}

} // namespace

SmoothBody& SmoothBody::group(double blend) {
    groups_.push_back({blend, {}});
    return *this;
}

SmoothBody& SmoothBody::cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b, double blend) {
    Part part;
    part.blend = blend;
    part.a = a;
    part.length = glm::distance(a, b);
    part.b = part.length > 0 ? (b - a) / part.length : Vec3(0, 1, 0);
    part.radius = radius_a;
    part.slope = part.length > 0 ? (radius_b - radius_a) / part.length : 0;
    groups_.back().parts.push_back(part);
    return *this;
}

SmoothBody& SmoothBody::ball(const Vec3& centre, double radius, double blend) {
    return cone(centre, radius, centre, radius, blend);
}

SmoothBody& SmoothBody::ellipsoid(const Vec3& centre, const Vec3& half_axes, double blend, double turn_x,
                                  double turn_z) {
    Part part;
    part.is_ellipsoid = true;
    part.blend = blend;
    part.a = centre;
    part.b = half_axes;
    part.frame = glm::transpose(rotation({0, 0, 1}, turn_z) * rotation({1, 0, 0}, turn_x));
    groups_.back().parts.push_back(part);
    return *this;
}

SmoothBody& SmoothBody::carved() {
    groups_.back().parts.back().carves = true;
    return *this;
}

SmoothBody& SmoothBody::cut_below(double height, double blend) {
    cut_height_ = height;
    cut_blend_ = blend;
    return *this;
}

FieldValue SmoothBody::value_of(const Part& part, const Vec3& p) {
    const Vec3 q = p - part.a;
    if (part.is_ellipsoid) {
        // |q| as the ellipsoid measures it, scaled by the length of its gradient: exact at the surface to
        // first order.
        const Vec3 local = part.frame * q;
        const Vec3 once = local / part.b;
        const Vec3 twice = once / part.b;
        const double k0 = glm::length(once);
        const double k1 = glm::length(twice);
        if (!(k1 > 0)) {
            return {-std::min({part.b.x, part.b.y, part.b.z}), Vec3(0)};
        }
        const double value = k0 * (k0 - 1) / k1;
        const Vec3 slope0 = twice / k0;
        const Vec3 slope1 = twice / (part.b * part.b) / k1;
        const Vec3 gradient = ((2 * k0 - 1) * slope0 - value * slope1) / k1;
        return {value, gradient * part.frame};
    }
    // The distance to the cone is the least of |p - c| - r over the balls on the axis; where it is least, the
    // gradient is that of this ball.
    const double along = glm::dot(q, part.b);
    const double aside = std::sqrt(std::max(glm::dot(q, q) - along * along, 0.0));
    const double lean = part.slope / std::sqrt(1 - part.slope * part.slope);
    const double at = std::clamp(along + aside * lean, 0.0, part.length);
    const Vec3 from_axis = q - at * part.b;
    const double distance = glm::length(from_axis);
    return {distance - part.radius - part.slope * at, distance > 0 ? from_axis / distance : Vec3(0)};
}

FieldValue SmoothBody::value_of(const Group& group, const Vec3& p) {
    FieldValue result{infinity, Vec3(0)};
    for (const Part& part : group.parts) {
        const FieldValue value = value_of(part, p);
        result = part.carves ? negated(smooth_min(negated(result), value, part.blend))
                             : smooth_min(result, value, part.blend);
    }
    return result;
}

FieldValue SmoothBody::evaluate(const Vec3& p) const {
    FieldValue result{infinity, Vec3(0)};
    for (const Group& group : groups_) {
        result = smooth_min(result, value_of(group, p), group.blend);
    }
    if (cut_height_ > -infinity) {
        result = negated(smooth_min(negated(result), {p.y - cut_height_, Vec3(0, 1, 0)}, cut_blend_));
    }
    return result;
}

Vec3 SmoothBody::project(const Vec3& start) const {
    Vec3 p = start;
    for (int i = 0; i < 10; ++i) {
        const FieldValue at = evaluate(p);
        const double slope2 = glm::dot(at.gradient, at.gradient);
        if (std::abs(at.value) < 1e-12 || !(slope2 > 0)) {
            break;
        }
        p -= at.value / slope2 * at.gradient;
    }
    return p;
}

} // namespace anvil
