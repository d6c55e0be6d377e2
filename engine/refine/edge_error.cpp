#include "engine/refine/edge_error.h"

#include "engine/distance/anchor_blend.h"

namespace anvil {

namespace {

// Samples between two breaks. Between breaks the error is a smooth arc of few extrema, each of which is then
// climbed; the samples only have to see it.
constexpr std::array<double, 6> piece_samples{0.07, 0.24, 0.41, 0.59, 0.76, 0.93};
// Near the foot of a source close to the edge the distance turns within the source's height.
constexpr std::array<double, 4> foot_samples{0.3, 0.8, 1.6, 4};
// A sample this far below what counts hides no larger extremum beside it.
constexpr double worth_climbing = 0.5;
constexpr int climbing_steps = 10;
constexpr int blend_samples = 24;
constexpr int bisections = 50;

} // namespace

EdgeMeasure::EdgeMeasure(const HandleField& handle) : handle_(handle), levels_(shape_levels(handle)) {
    const auto& segments = handle.shape.segments();
    for (size_t i = 0; i < segments.size(); ++i) {
        const ShapeSegmentD& p = segments[i];
        const double h = (i + 1 < segments.size() ? segments[i + 1].begin : 1) - p.begin;
        // The slope is a parabola: extreme at its ends or its vertex.
        const double end = p.c1 + h * (2 * p.c2 + h * 3 * p.c3);
        const double turn = -p.c2 / (3 * p.c3);
        const double middle = turn > 0 && turn < h ? p.c1 + turn * p.c2 : 0;
        bounds_.push_back({std::max({std::abs(p.c1), std::abs(end), std::abs(middle)}),
                           std::max(std::abs(2 * p.c2), std::abs(2 * p.c2 + 6 * p.c3 * h))});
    }
    spread_ = handle.blend * std::log(static_cast<double>(std::max<size_t>(1, handle.anchors.size())));
}

/// False where the edge is out of the handle's reach.
bool EdgeMeasure::load(const EdgeSpan& edge) {
    edge_ = edge;
    parts_.clear();
    double least = infinity;
    for (const AnchorField& anchor : handle_.anchors) {
        const double d0 = anchor.distances[edge.a];
        const double d1 = anchor.distances[edge.b];
        // A distance that was not found lies so far out that its whole edge does.
        if (std::isfinite(d0) && std::isfinite(d1)) {
            parts_.emplace_back(d0, d1, edge.length, anchor.kind);
            least = std::min(least, parts_.back().least());
        }
    }
    if (!(edge.length > 0) || least - spread_ >= handle_.radius) {
        return false;
    }
    drop_hidden_parts();
    start_value_ = handle_.shape(gamma(0) / handle_.radius);
    end_value_ = handle_.shape(gamma(edge.length) / handle_.radius);
    return true;
}

void EdgeMeasure::drop_hidden_parts() {
    // Every anchor counts in a blend, however little.
    if (parts_.size() < 2 || handle_.blend > 0) {
        return;
    }
    double reach = infinity;
    for (const EdgeDistance& part : parts_) {
        reach = std::min(reach, part.greatest());
    }
    parts_.erase(std::remove_if(parts_.begin(), parts_.end(),
                                [&](const EdgeDistance& part) { return part.least() > reach; }),
                 parts_.end());
}

double EdgeMeasure::gamma(double s) {
    if (parts_.size() == 1 && handle_.blend == 0) {
        return parts_.front().at(s);
    }
    each_.clear();
    for (const EdgeDistance& part : parts_) {
        each_.push_back(part.at(s));
    }
    each_.resize(handle_.blend > 0 ? handle_.anchors.size() : each_.size(), infinity);
    return smooth_minimum(each_, handle_.blend);
}

double EdgeMeasure::error(double s) {
    const double part = s / edge_.length;
    return handle_.shape(gamma(s) / handle_.radius) - ((1 - part) * start_value_ + part * end_value_);
}

EdgeMeasure::Bounds EdgeMeasure::bounds_between(double low, double high) const {
    const auto& segments = handle_.shape.segments();
    Bounds most{0, 0};
    for (size_t i = 0; i < segments.size(); ++i) {
        const double end = i + 1 < segments.size() ? segments[i + 1].begin : 1;
        if (segments[i].begin <= high && end >= low) {
            most.slope = std::max(most.slope, bounds_[i].slope);
            most.curvature = std::max(most.curvature, bounds_[i].curvature);
        }
    }
    return most;
}

/// A bound that most edges of a fine mesh pass: |e| <= L^2 / 8 max|e''|, with |g'| <= 1 and g'' <= 1 / g.
double EdgeMeasure::smooth_bound() const {
    if (parts_.size() != 1 || handle_.blend > 0) {
        return infinity;
    }
    const EdgeDistance& part = parts_.front();
    for (const ShapeLevel& level : levels_) {
        if (level.kink && level.distance > part.least() && level.distance < part.greatest()) {
            return infinity;
        }
    }
    const double r = handle_.radius;
    const Bounds bound = bounds_between(part.least() / r, part.greatest() / r);
    const double bend = part.is_linear() ? 0 : bound.slope / (r * part.least());
    return edge_.length * edge_.length / 8 * (bound.curvature / (r * r) + bend);
}

EdgeError EdgeMeasure::worst(const EdgeSpan& edge, double enough) {
    if (!load(edge)) {
        return {};
    }
    const double bound = smooth_bound();
    if (2 * bound <= enough) {
        return {2 * bound, 0, no_index};
    }
    above_ = below_ = {};
    find_breaks();
    for (const Break& b : breaks_) {
        try_place(b.s, b.level);
    }
    double from = 0;
    for (const Break& b : breaks_) {
        search_piece(from, b.s, enough);
        from = b.s;
    }
    search_piece(from, edge.length, enough);
    const Extreme& larger = above_.size > below_.size ? above_ : below_;
    return {above_.size + below_.size, larger.s / edge.length, larger.level};
}

void EdgeMeasure::find_breaks() {
    breaks_.clear();
    for (const EdgeDistance& part : parts_) {
        if (!std::isnan(part.turning_point())) {
            breaks_.push_back({part.turning_point(), no_index});
        }
    }
    find_crossings();
    for (uint32_t level = 0; level < levels_.size(); ++level) {
        find_level(level);
    }
    std::sort(breaks_.begin(), breaks_.end(), [](const Break& x, const Break& y) { return x.s < y.s; });
}

/// Places where two anchors are equally far. Both distances have s^2 in their squares, so that the
/// difference of the squares is linear.
void EdgeMeasure::find_crossings() {
    for (size_t i = 0; i < parts_.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            const double at_start = parts_[i].at(0) - parts_[j].at(0);
            const double at_end = parts_[i].at(edge_.length) - parts_[j].at(edge_.length);
            if (at_start * at_end >= 0) {
                continue;
            }
            double low = 0;
            double high = edge_.length;
            for (int step = 0; step < bisections; ++step) {
                const double middle = 0.5 * (low + high);
                const bool before = (parts_[i].at(middle) - parts_[j].at(middle)) * at_start > 0;
                (before ? low : high) = middle;
            }
            breaks_.push_back({0.5 * (low + high), no_index});
        }
    }
}

void EdgeMeasure::find_level(uint32_t level) {
    const double wanted = levels_[level].distance;
    const uint32_t mark = levels_[level].kink ? level : no_index;
    if (handle_.blend > 0) {
        find_blended_level(level);
        return;
    }
    for (const EdgeDistance& part : parts_) {
        for (const double s : part.places_at(wanted)) {
            // Another anchor may be nearer there.
            if (!std::isnan(s) && gamma(s) >= wanted * (1 - 1e-12)) {
                breaks_.push_back({s, mark});
            }
        }
    }
}

void EdgeMeasure::find_blended_level(uint32_t level) {
    const double wanted = levels_[level].distance;
    double before = gamma(0) - wanted;
    for (int i = 1; i <= blend_samples; ++i) {
        double high = edge_.length * i / blend_samples;
        const double after = gamma(high) - wanted;
        if (before * after < 0) {
            double low = edge_.length * (i - 1) / blend_samples;
            for (int step = 0; step < bisections; ++step) {
                const double middle = 0.5 * (low + high);
                ((gamma(middle) - wanted) * before > 0 ? low : high) = middle;
            }
            breaks_.push_back({0.5 * (low + high), levels_[level].kink ? level : no_index});
        }
        before = after;
    }
}

void EdgeMeasure::try_place(double s, uint32_t level) {
    const double found = error(s);
    Extreme& side = found > 0 ? above_ : below_;
    if (std::abs(found) > side.size) {
        side = {std::abs(found), s, level};
    }
}

void EdgeMeasure::sample_piece(double from, double to) {
    const double width = to - from;
    samples_.assign(1, from);
    for (const double part : piece_samples) {
        samples_.push_back(from + part * width);
    }
    for (int i = 1; handle_.blend > 0 && i < blend_samples; ++i) {
        samples_.push_back(from + width * i / blend_samples);
    }
    samples_.push_back(to);
    for (const EdgeDistance& part : parts_) {
        const double foot = part.turning_point();
        if (std::isnan(foot) || part.least() > 0.2 * edge_.length) {
            continue;
        }
        for (const double heights : foot_samples) {
            for (const double s : {foot - heights * part.least(), foot + heights * part.least()}) {
                if (s > from && s < to) {
                    samples_.push_back(s);
                }
            }
        }
    }
    std::sort(samples_.begin(), samples_.end());
}

void EdgeMeasure::search_piece(double from, double to, double enough) {
    if (!(to - from > 1e-12 * edge_.length)) {
        return;
    }
    sample_piece(from, to);
    size_t highest = 0;
    size_t lowest = 0;
    double high = 0;
    double low = 0;
    for (size_t i = 1; i + 1 < samples_.size(); ++i) {
        const double found = error(samples_[i]);
        if (found > high) {
            highest = i;
            high = found;
        } else if (found < low) {
            lowest = i;
            low = found;
        }
    }
    if (high > worth_climbing * std::max(0.5 * enough, above_.size)) {
        try_place(climb(samples_[highest - 1], samples_[highest + 1], 1), no_index);
    } else if (high > above_.size) {
        try_place(samples_[highest], no_index);
    }
    if (-low > worth_climbing * std::max(0.5 * enough, below_.size)) {
        try_place(climb(samples_[lowest - 1], samples_[lowest + 1], -1), no_index);
    } else if (-low > below_.size) {
        try_place(samples_[lowest], no_index);
    }
}

/// Golden section: sign * error has one maximum between the neighbours of its highest sample.
double EdgeMeasure::climb(double from, double to, double sign) {
    constexpr double golden = 0.6180339887498949;
    double left = to - golden * (to - from);
    double right = from + golden * (to - from);
    double at_left = sign * error(left);
    double at_right = sign * error(right);
    for (int step = 0; step < climbing_steps; ++step) {
        if (at_left > at_right) {
            to = right;
            right = left;
            at_right = at_left;
            left = to - golden * (to - from);
            at_left = sign * error(left);
        } else {
            from = left;
            left = right;
            at_left = at_right;
            right = from + golden * (to - from);
            at_right = sign * error(right);
        }
    }
    return at_left > at_right ? left : right;
}

double EdgeMeasure::distance(const EdgeSpan& edge, double place) {
    each_.clear();
    for (const AnchorField& anchor : handle_.anchors) {
        each_.push_back(distance_between(anchor.distances[edge.a], anchor.distances[edge.b], edge.length,
                                         place, anchor.kind));
    }
    return handle_.blended(each_);
}

const std::vector<double>& EdgeMeasure::crossings(const EdgeSpan& edge, size_t level) {
    places_.clear();
    if (load(edge)) {
        breaks_.clear();
        find_level(static_cast<uint32_t>(level));
        for (const Break& b : breaks_) {
            places_.push_back(b.s / edge.length);
        }
        std::sort(places_.begin(), places_.end());
    }
    return places_;
}

} // namespace anvil
