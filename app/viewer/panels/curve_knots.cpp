#include "app/viewer/panels/curve_editor.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr double least_gap = 0.005; ///< of t: what a mouse can tell apart

double slope_at(const ShapeFunction& phi, double t) {
    constexpr double step = 1e-6;
    return (phi(std::min(t + step, 1.0)) - phi(std::max(t - step, 0.0))) / (2 * step);
}

} // namespace

ShapeChoice with_own_knots(const ShapeChoice& shape) {
    return shape.preset.empty() ? shape : ShapeChoice{"", preset_knots(shape.preset)};
}

size_t add_knot(ShapeChoice& shape, double t) {
    std::vector<Knot>& knots = shape.knots;
    t = std::clamp(t, least_gap, 1 - least_gap);
    const auto nearest = std::min_element(knots.begin(), knots.end(), [t](const Knot& a, const Knot& b) {
        return std::abs(a.t - t) < std::abs(b.t - t);
    });
    if (std::abs(nearest->t - t) < least_gap) {
        return static_cast<size_t>(nearest - knots.begin());
    }
    const ShapeFunction phi = make_shape_function(shape);
    const double slope = slope_at(phi, t);
    const Knot knot{t, phi(t), slope, slope};
    const auto place =
        std::find_if(knots.begin(), knots.end(), [t](const Knot& other) { return other.t > t; });
    const auto inserted = knots.insert(place, knot); // moves the beginning too
    return static_cast<size_t>(inserted - knots.begin());
}

void move_knot(ShapeChoice& shape, size_t index, double t, double value, double most_value) {
    std::vector<Knot>& knots = shape.knots;
    if (index + 1 >= knots.size() || !std::isfinite(t) || !std::isfinite(value)) {
        return; // the last one ends the region: phi is 0 there
    }
    const double low = index == 0 ? knots[0].t : knots[index - 1].t + least_gap;
    const double high = index == 0 ? knots[0].t : knots[index + 1].t - least_gap;
    knots[index].t = low <= high ? std::clamp(t, low, high) : knots[index].t;
    knots[index].value = std::clamp(value, -most_value, most_value);
}

void turn_slope(Knot& knot, bool left, double slope, bool kink) {
    const bool apart = kink || (knot.left && knot.right && *knot.left != *knot.right);
    if (left || !apart) {
        knot.left = slope;
    }
    if (!left || !apart) {
        knot.right = slope;
    }
}

bool remove_knot(ShapeChoice& shape, size_t index) {
    if (index == 0 || index + 1 >= shape.knots.size()) {
        return false;
    }
    shape.knots.erase(shape.knots.begin() + static_cast<std::ptrdiff_t>(index));
    return true;
}

} // namespace anvil
