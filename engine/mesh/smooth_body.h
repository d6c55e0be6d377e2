// Solids of round cones and ellipsoids that melt into each other, with exact gradients.
#pragma once

#include "engine/core/types.h"

#include <vector>

namespace anvil {

struct FieldValue {
    double value = 0; ///< negative inside; near the surface about the distance
    Vec3 gradient{0};
};

/// A smooth implicit solid. Parts are joined in the order in which they are added: each blends with what
/// stands before it over its `blend` width (cubic smooth minimum: twice continuously differentiable in the
/// two values); blend 0 is a plain union. Parts of one group are joined among themselves first.
class SmoothBody {
  public:
    /// Starts a group, which joins the body over `blend` once the next group begins.
    SmoothBody& group(double blend);
    /// Two balls and the cone that touches both; neither ball may contain the other.
    SmoothBody& cone(const Vec3& a, double radius_a, const Vec3& b, double radius_b, double blend);
    /// Half axes along x, y, z, then turned around x, then around z, by degrees.
    SmoothBody& ellipsoid(const Vec3& centre, const Vec3& half_axes, double blend, double turn_x = 0,
                          double turn_z = 0);
    SmoothBody& ball(const Vec3& centre, double radius, double blend);
    /// Makes the part added last take away from its group instead.
    SmoothBody& carved();
    /// Keeps only what lies above y = height; the rim is rounded over `blend`. Applies to the whole body.
    SmoothBody& cut_below(double height, double blend);

    FieldValue evaluate(const Vec3& p) const;
    double operator()(const Vec3& p) const { return evaluate(p).value; }

    /// The point of the surface reached from `start` by Newton's steps along the gradient.
    Vec3 project(const Vec3& start) const;

  private:
    struct Part {
        bool is_ellipsoid = false;
        bool carves = false;
        double blend = 0;
        Vec3 a{0}; ///< centre, or first ball's centre
        Vec3 b{0}; ///< half axes, or unit axis of the cone
        double length = 0;
        double radius = 0;
        double slope = 0;    ///< cone: growth of the radius per length along the axis
        double lean = 0;     ///< cone: tangent of the angle between its sides and its axis
        glm::dmat3 frame{1}; ///< ellipsoid: from the world to its axes
        // The value is at least |p - middle| * bound_slope - bound_offset.
        Vec3 middle{0};
        double bound_slope = 1;
        double bound_offset = 0;
    };
    struct Group {
        double blend = 0;
        std::vector<Part> parts;
        Box box; ///< of the cones
        double swelling =
            0; ///< the value is at least the box's distance minus this; infinite with ellipsoids
    };

    void add(const Part& part);
    static bool is_far(const Part& part, const Vec3& p, double value);
    static bool is_far(const Group& group, const Vec3& p, double value);

    static FieldValue value_of_ellipsoid(const Part& part, const Vec3& p);
    static FieldValue value_of_cone(const Part& part, const Vec3& p);
    static FieldValue value_of(const Group& group, const Vec3& p);

    std::vector<Group> groups_;
    double cut_height_ = -infinity;
    double cut_blend_ = 0;
};

} // namespace anvil
