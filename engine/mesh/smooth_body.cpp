#include "engine/mesh/smooth_body.h"

#include <numbers>

namespace anvil {

namespace {

FieldValue negated(const FieldValue& f) {
    return {-f.value, -f.gradient};
}

/// a becomes the smooth minimum of a and b; from a difference of `width` on, exactly the lesser one.
void join(FieldValue& a, const FieldValue& b, double width) {
    const double apart = std::abs(a.value - b.value);
    if (!(apart < width)) {
        if (b.value < a.value) {
            a = b;
        }
        return;
    }
    const double h = 1 - apart / width;
    const double share = a.value < b.value ? 0.5 * h * h : 1 - 0.5 * h * h; // of b in the gradient
    a = {std::min(a.value, b.value) - h * h * h * width / 6, (1 - share) * a.gradient + share * b.gradient};
}

double square(double x) {
    return x * x;
}

glm::dmat3 rotation(const Vec3& axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return axis.x > 0 ? glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c) : glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
}

} // namespace

SmoothBody& SmoothBody::group(double blend) {
    groups_.push_back({blend, {}, {}, 0});
    return *this;
}

void SmoothBody::add(const Part& part) {
    Group& group = groups_.back();
    group.parts.push_back(part);
    group.swelling += part.is_ellipsoid ? infinity : part.blend / 6;
    group.box.include(part.middle - part.bound_offset);
    group.box.include(part.middle + part.bound_offset);
}

SmoothBody& SmoothBody::cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b, double blend) {
    Part part;
    part.blend = blend;
    part.a = a;
    part.length = glm::distance(a, b);
    part.b = part.length > 0 ? (b - a) / part.length : Vec3(0, 1, 0);
    part.radius = radius_a;
    part.slope = part.length > 0 ? (radius_b - radius_a) / part.length : 0;
    part.lean = part.slope / std::sqrt(1 - part.slope * part.slope);
    part.middle = 0.5 * (a + b);
    part.bound_offset = 0.5 * part.length + std::max(radius_a, radius_b);
    add(part);
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
    // k0 (k0 - 1) / k1 with k0 >= |q| / greatest and k1 <= k0 / least half axis.
    const double least = std::min({half_axes.x, half_axes.y, half_axes.z});
    part.middle = centre;
    part.bound_slope = least / std::max({half_axes.x, half_axes.y, half_axes.z});
    part.bound_offset = least;
    add(part);
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

/// True if the part's value at p is certainly not below `value`.
bool SmoothBody::is_far(const Part& part, const Vec3& p, double value) {
    const double reach = value + part.bound_offset;
    const Vec3 q = p - part.middle;
    return reach <= 0 || glm::dot(q, q) * square(part.bound_slope) >= square(reach);
}

bool SmoothBody::is_far(const Group& group, const Vec3& p, double value) {
    const Vec3 outside = glm::max(glm::max(group.box.low - p, p - group.box.high), Vec3(0));
    const double reach = value + group.swelling;
    return reach > 0 && glm::dot(outside, outside) >= square(reach);
}

/// |q| as the ellipsoid measures it, over the length of its gradient: near the surface the distance to first
/// order.
FieldValue SmoothBody::value_of_ellipsoid(const Part& part, const Vec3& p) {
    const Vec3 once = part.frame * (p - part.a) / part.b;
    const Vec3 twice = once / part.b;
    const double k0 = glm::length(once);
    const double k1 = glm::length(twice);
    if (!(k1 > 0)) {
        return {-std::min({part.b.x, part.b.y, part.b.z}), Vec3(0)};
    }
    const double value = k0 * (k0 - 1) / k1;
    const Vec3 slope0 = twice / k0;
    const Vec3 slope1 = twice / (part.b * part.b) / k1;
    return {value, (((2 * k0 - 1) * slope0 - value * slope1) / k1) * part.frame};
}

/// The distance to the cone is the least of |p - c| - r over the balls on its axis; where it is least, the
/// gradient is that of this ball.
FieldValue SmoothBody::value_of_cone(const Part& part, const Vec3& p) {
    const Vec3 q = p - part.a;
    const double along = glm::dot(q, part.b);
    const double aside = std::sqrt(std::max(glm::dot(q, q) - along * along, 0.0));
    const double at = std::clamp(along + aside * part.lean, 0.0, part.length);
    const Vec3 from_axis = q - at * part.b;
    const double distance = glm::length(from_axis);
    return {distance - part.radius - part.slope * at, distance > 0 ? from_axis / distance : Vec3(0)};
}

FieldValue SmoothBody::value_of(const Group& group, const Vec3& p) {
    FieldValue result{infinity, Vec3(0)};
    for (const Part& part : group.parts) {
        const double sign = part.carves ? -1 : 1;
        if (!is_far(part, p, sign * result.value + part.blend)) {
            FieldValue sum = part.carves ? negated(result) : result;
            join(sum, part.is_ellipsoid ? value_of_ellipsoid(part, p) : value_of_cone(part, p), part.blend);
            result = part.carves ? negated(sum) : sum;
        }
    }
    return result;
}

FieldValue SmoothBody::evaluate(const Vec3& p) const {
    FieldValue result{infinity, Vec3(0)};
    for (const Group& group : groups_) {
        if (!is_far(group, p, result.value + group.blend)) {
            join(result, value_of(group, p), group.blend);
        }
    }
    if (cut_height_ > -infinity) {
        FieldValue outside = negated(result);
        join(outside, {p.y - cut_height_, Vec3(0, 1, 0)}, cut_blend_);
        result = negated(outside);
    }
    return result;
}

Vec3 SmoothBody::project(const Vec3& start) const {
    Vec3 p = start;
    for (int i = 0; i < 12; ++i) {
        const FieldValue at = evaluate(p);
        const double slope2 = glm::dot(at.gradient, at.gradient);
        if (!(slope2 > 0)) {
            break;
        }
        p -= at.value / slope2 * at.gradient;
        // The step squares the error (times the curvature, under 100): what it leaves is rounding.
        if (std::abs(at.value) < 1e-8) {
            break;
        }
    }
    return p;
}

} // namespace anvil
