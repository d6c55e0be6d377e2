#include "engine/edit/shape_function.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t max_knots = 256;
constexpr double min_gap = 1e-6;
constexpr double max_value = 1e6;
constexpr double max_slope = 1e12;
constexpr double end_tolerance = 1e-12;

[[noreturn]] void fail(size_t knot, const std::string& key, const std::string& what) {
    throw InputError("knots[" + std::to_string(knot) + "]" + key + ": " + what);
}

// Written so that NaN fails too.
bool within(double x, double limit) {
    return std::abs(x) <= limit;
}

void check_knot(size_t i, const Knot& knot) {
    if (!(knot.t >= 0 && knot.t <= 1)) {
        fail(i, ".t", "found " + number_text(knot.t) + "; must be within [0, 1]");
    }
    if (!within(knot.value, max_value)) {
        fail(i, ".value", "found " + number_text(knot.value) + "; must be a number within [-1e6, 1e6]");
    }
    for (const auto& slope : {knot.left, knot.right}) {
        if (slope && !within(*slope, max_slope)) {
            fail(i, slope == knot.left ? ".left" : ".right",
                 "the slope " + number_text(*slope) + " must be a number within [-1e12, 1e12]");
        }
    }
}

void check_order(size_t i, double before, double t) {
    if (t <= before) {
        fail(i, ".t",
             "found " + number_text(t) + " after " + number_text(before) +
                 "; t must increase from knot to knot");
    }
    if (t - before < min_gap) {
        fail(i, ".t",
             "only " + number_text(t - before) +
                 " from the knot before, which is a jump; keep knots at least 1e-6 apart");
    }
}

void check(const std::vector<Knot>& knots) {
    if (knots.size() < 2 || knots.size() > max_knots) {
        throw InputError("knots: found " + std::to_string(knots.size()) + "; a shape needs 2 to " +
                         std::to_string(max_knots) + " knots");
    }
    for (size_t i = 0; i < knots.size(); ++i) {
        check_knot(i, knots[i]);
        if (i > 0) {
            check_order(i, knots[i - 1].t, knots[i].t);
        }
    }
    if (!within(knots.back().value, end_tolerance)) {
        fail(knots.size() - 1, ".value",
             "the last value is " + number_text(knots.back().value) +
                 ", a jump at the end of the region; it must be 0 (add a knot with t 1 and value 0)");
    }
}

double secant(const Knot& a, const Knot& b) {
    return (b.value - a.value) / (b.t - a.t);
}

// Fritsch & Carlson: the mean of the secants, 0 at a local extremum, at most 3 times the flatter secant.
// The cube [0, 3]^2 of slope/secant ratios lies in their monotone region, so free slopes do not depend on
// the order in which segments are visited.
double monotone_slope(const std::vector<Knot>& knots, size_t i) {
    if (i == 0) {
        return secant(knots[0], knots[1]);
    }
    const double before = secant(knots[i - 1], knots[i]);
    if (i + 1 == knots.size()) {
        return before;
    }
    const double after = secant(knots[i], knots[i + 1]);
    if (before * after <= 0) {
        return 0;
    }
    const double limit = 3 * std::min(std::abs(before), std::abs(after));
    return std::clamp(0.5 * (before + after), -limit, limit);
}

ShapeSegmentD hermite(const Knot& a, double slope_a, const Knot& b, double slope_b) {
    const double h = b.t - a.t;
    const double d = secant(a, b);
    return {a.t, a.value, slope_a, (3 * d - 2 * slope_a - slope_b) / h,
            (slope_a + slope_b - 2 * d) / (h * h)};
}

std::vector<ShapeSegmentD> make_segments(const std::vector<Knot>& knots) {
    std::vector<ShapeSegmentD> segments;
    if (knots.front().t > 0) {
        segments.push_back({0, knots.front().value, 0, 0, 0});
    }
    for (size_t i = 0; i + 1 < knots.size(); ++i) {
        const double right = knots[i].right.value_or(monotone_slope(knots, i));
        const double left = knots[i + 1].left.value_or(monotone_slope(knots, i + 1));
        segments.push_back(hermite(knots[i], right, knots[i + 1], left));
    }
    if (knots.back().t < 1) {
        segments.push_back({knots.back().t, 0, 0, 0, 0});
    }
    return segments;
}

double value_at(const ShapeSegmentD& p, double s) {
    return p.c0 + s * (p.c1 + s * (p.c2 + s * p.c3));
}

double slope_at(const ShapeSegmentD& p, double s) {
    return p.c1 + s * (2 * p.c2 + s * 3 * p.c3);
}

double length_of(const std::vector<ShapeSegmentD>& segments, size_t i) {
    return (i + 1 < segments.size() ? segments[i + 1].begin : 1.0) - segments[i].begin;
}

// Zeros of the slope; the quotient form keeps both roots where c3 is small.
double extreme_value(const ShapeSegmentD& p, double h) {
    double result = std::max(std::abs(value_at(p, 0)), std::abs(value_at(p, h)));
    const double discriminant = p.c2 * p.c2 - 3 * p.c3 * p.c1;
    if (discriminant < 0) {
        return result;
    }
    const double q = -(p.c2 + std::copysign(std::sqrt(discriminant), p.c2));
    for (const double s : {q / (3 * p.c3), p.c1 / q}) {
        if (s > 0 && s < h) {
            result = std::max(result, std::abs(value_at(p, s)));
        }
    }
    return result;
}

double extreme_slope(const ShapeSegmentD& p, double h) {
    const double ends = std::max(std::abs(slope_at(p, 0)), std::abs(slope_at(p, h)));
    const double s = -p.c2 / (3 * p.c3);
    return s > 0 && s < h ? std::max(ends, std::abs(slope_at(p, s))) : ends;
}

} // namespace

ShapeFunction::ShapeFunction() : ShapeFunction(preset_knots("smooth")) {}

ShapeFunction::ShapeFunction(std::vector<Knot> knots) : knots_(std::move(knots)) {
    check(knots_);
    segments_ = make_segments(knots_);
}

double ShapeFunction::operator()(double t) const {
    if (t > 1) {
        return 0;
    }
    const double clamped = std::max(t, 0.0);
    const auto next = std::upper_bound(segments_.begin(), segments_.end(), clamped,
                                       [](double x, const ShapeSegmentD& p) { return x < p.begin; });
    const ShapeSegmentD& segment = next == segments_.begin() ? *next : *(next - 1);
    return value_at(segment, clamped - segment.begin);
}

double ShapeFunction::lipschitz() const {
    double result = 0;
    for (size_t i = 0; i < segments_.size(); ++i) {
        result = std::max(result, extreme_slope(segments_[i], length_of(segments_, i)));
    }
    return result;
}

double ShapeFunction::max_magnitude() const {
    double result = 0;
    for (size_t i = 0; i < segments_.size(); ++i) {
        result = std::max(result, extreme_value(segments_[i], length_of(segments_, i)));
    }
    return result;
}

} // namespace anvil
