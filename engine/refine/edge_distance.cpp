#include "engine/refine/edge_distance.h"

namespace anvil {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
// Approximate distances are sums of floats: less than this is their rounding, not a way around.
constexpr double shortcut = 1e-5;

bool inside(double s, double length) {
    return s > 0 && s < length;
}

} // namespace

EdgeDistance::EdgeDistance(double d0, double d1, double length, SourceKind kind)
    : d0_(d0), d1_(d1), length_(length) {
    if (!std::isfinite(d0) || !std::isfinite(d1)) {
        form_ = Form::one_end;
    } else if (kind == SourceKind::line || std::abs(d0 - d1) >= length) {
        form_ = Form::linear;
    } else {
        form_ = d0 + d1 < length * (1 - shortcut) ? Form::meeting : Form::source;
    }
    find_extremes();
}

void EdgeDistance::find_extremes() {
    turning_ = nowhere;
    least_ = std::min(d0_, d1_);
    greatest_ = std::max(d0_, d1_);
    if (form_ == Form::source || form_ == Form::meeting) {
        const double s = form_ == Form::source ? 0.5 * (length_ + (d0_ - d1_) * ((d0_ + d1_) / length_))
                                               : 0.5 * (length_ + (d1_ - d0_));
        if (inside(s, length_)) {
            turning_ = s;
            least_ = std::min(least_, at(s));
            greatest_ = std::max(greatest_, at(s));
        }
    }
}

double EdgeDistance::at(double s) const {
    const double part = s / length_;
    switch (form_) {
    case Form::linear:
        return d0_ + (d1_ - d0_) * part;
    case Form::meeting:
        return std::min(d0_ + s, d1_ + (length_ - s));
    case Form::one_end:
        return std::isfinite(d0_) ? d0_ + s : d1_ + (length_ - s);
    case Form::source:
        break;
    }
    return std::sqrt(std::max(0.0, (1 - part) * d0_ * d0_ + part * d1_ * d1_ - s * (length_ - s)));
}

std::array<double, 2> EdgeDistance::places_at(double distance) const {
    double first = nowhere;
    double second = nowhere;
    if (form_ == Form::linear) {
        first = length_ * ((distance - d0_) / (d1_ - d0_));
    } else if (form_ == Form::meeting) {
        if (distance <= greatest_) {
            first = distance - d0_;
            second = d1_ + length_ - distance;
        }
    } else if (form_ == Form::source) {
        // s^2 - 2 x s + (d0 - g)(d0 + g) = 0, x the foot; the larger root first, so that none cancels.
        const double foot = 0.5 * (length_ + (d0_ - d1_) * ((d0_ + d1_) / length_));
        const double constant = (d0_ - distance) * (d0_ + distance);
        const double square = foot * foot - constant;
        if (square >= 0) {
            const double larger = foot + std::copysign(std::sqrt(square), foot);
            first = larger;
            second = constant / larger;
        }
    }
    std::array<double, 2> places{inside(first, length_) ? first : nowhere,
                                 inside(second, length_) ? second : nowhere};
    if (std::isnan(places[0]) || places[1] < places[0]) {
        std::swap(places[0], places[1]);
    }
    return places;
}

double distance_between(double d0, double d1, double length, double place, SourceKind kind) {
    if (!std::isfinite(d0) && !std::isfinite(d1)) {
        return infinity;
    }
    return length > 0 ? EdgeDistance(d0, d1, length, kind).at(place * length) : d0;
}

} // namespace anvil
