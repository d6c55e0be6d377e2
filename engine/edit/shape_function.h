// Shape functions: how much of a handle's displacement reaches a point, by its distance from the anchors.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// A point of a shape function's curve. `t` is dimensionless (distance over radius), `left` and `right` are
/// the slopes d(value)/dt on either side; slopes that differ make a kink. A slope that is not given becomes
/// a monotone one.
struct Knot {
    double t = 0;
    double value = 0;
    std::optional<double> left;
    std::optional<double> right;

    bool operator==(const Knot&) const = default;
};

/// phi(t) = c0 + s (c1 + s (c2 + s c3)), s = t - begin, from `begin` up to the next segment's begin.
struct ShapeSegmentD {
    double begin = 0;
    double c0 = 0;
    double c1 = 0;
    double c2 = 0;
    double c3 = 0;

    bool operator==(const ShapeSegmentD&) const = default;
};

/// phi of section 2.3 of Bendels & Klein 2003: cubic Hermite between knots, given as polynomial segments
/// that the kernels evaluate too. The first segment begins at 0; before the first knot phi has its value,
/// after the last knot it is 0, and phi(t) = 0 for t > 1.
class ShapeFunction {
  public:
    /// The preset "smooth".
    ShapeFunction();

    /// 2 to 256 knots, t strictly increasing in [0, 1] and at least 1e-6 apart (closer is a jump), |value| up
    /// to 1e6 and |slope| up to 1e12. The last value must be 0 to within 1e-12: phi may not jump at its end.
    /// @throws InputError that begins with the place, e.g. "knots[2].t: ...".
    explicit ShapeFunction(std::vector<Knot> knots);

    double operator()(double t) const;

    /// Least Lipschitz constant, max |phi'| over [0, 1], extrema inside segments included.
    double lipschitz() const;
    /// max |phi| over [0, 1], extrema inside segments included.
    double max_magnitude() const;

    const std::vector<Knot>& knots() const { return knots_; }
    const std::vector<ShapeSegmentD>& segments() const { return segments_; }

  private:
    std::vector<Knot> knots_;
    std::vector<ShapeSegmentD> segments_;
};

/// Published knots of a preset: smooth, linear, sphere, root, sharp, plateau, constant, crater, wave, rim.
/// @throws InputError that names the presets.
const std::vector<Knot>& preset_knots(const std::string& name);

/// All preset names, "smooth" first.
std::vector<std::string> preset_names();

/// The same for messages: "smooth, linear, ...".
std::string preset_list();

} // namespace anvil
