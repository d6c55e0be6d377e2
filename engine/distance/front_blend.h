// What a front is at a vertex, and how those of an edge's two ends reach a point beyond it.
#pragma once

#include "engine/distance/angle_functions.h"

#include <cstdint>

namespace anvil {

/// Near its vertex the distance is `offset` plus the way to a centre, which lies at distance - offset in
/// direction `back`: bends (offset: distance of the bend) are kept. Record of a workspace, 32 bytes.
struct Front {
    float distance = 0;
    float offset = 0; ///< distance of the centre itself from the source
    float back = 0;   ///< direction of the centre
    uint32_t label = 0;
    uint32_t parents = 0; ///< that the value came from: both ends of an edge xored, or ~ of a single one
    uint32_t stamp = 0;   ///< run, then times marched from, then flags
    float total = 0;      ///< Fan::total
    uint32_t first_spoke = 0;
};

struct FrontPoint {
    float x = 0, y = 0;
};

/// An edge as a point above it sees it: frame with the left end at the origin, the right one at (length, 0).
struct EdgeSight {
    float length, x, y;  ///< of the point: y > 0
    float out;           ///< direction of left to right at the left end
    float home;          ///< direction of right to left at the right end
    float begin, finish; ///< the part of the edge that is seen
};

/// A way over an edge to the point above it.
struct FrontArrival {
    static constexpr float never = 1e30F;
    float distance = never;
    FrontPoint centre; ///< in the frame of the sight
    uint32_t label = 0;
    /// How much the two fronts disagree at the ends of the edge; its length if they cannot be compared, 0 if
    /// both have their ways elsewhere.
    float miss = 0;
};

namespace front_blend {

// Chosen by trial on half of the meshes of bench_distance_errors. Mismatches in lengths of the edge.
inline constexpr float overlap_first = 0.15F; // where two overlapping fronts start to part,
inline constexpr float overlap_range = 0.45F; // and how long that takes
inline constexpr float gap_last = 3;       // with a gap between them (saddles): beyond it nothing is blended
inline constexpr float shadow_last = 0.5F; // the same where one passes through the shadow the other fills
inline constexpr float agreeing = 0.1F;    // of the larger mismatch: the smaller one says nothing

inline constexpr float pi = 3.14159265F;
inline constexpr float half_turn = 3.1415936F; // a little more than pi: rays along an edge count
inline constexpr float angle_slack = 1e-6F;

inline float distance_between(float dx, float dy) {
    return std::sqrt(dx * dx + dy * dy);
}

inline float clamp_unit(float t) {
    return std::min(std::max(t, 0.0F), 1.0F);
}

/// Where the ray from the centre (y >= 0: below the edge) to the point (x, y) crosses the edge.
inline float crossing(const FrontPoint& centre, float x, float y) {
    return (centre.x * y + x * centre.y) / (centre.y + y);
}

/// The centre seen from an end of the edge under `angle` away from the other end; false if it is not below
/// the edge.
inline bool place_centre(const Front& front, float angle, FrontPoint& along) {
    const float radius = front.distance - front.offset;
    if (!(radius > 0)) {
        along = {0, 0};
        return true;
    }
    angle += angle < -angle_slack ? front.total : 0;
    angle -= angle > front.total - angle_slack ? front.total : 0;
    const SineCosine t = half_turn_sine_cosine(std::min(std::max(angle, 0.0F), pi));
    along = {radius * t.cosine, std::max(0.0F, radius * t.sine)};
    return angle <= half_turn;
}

} // namespace front_blend

/// The way over the edge: a Hermite blend of the fronts of both ends where they agree, second order on smooth
/// surfaces and exact where the surface unfolds; the nearer one where they meet (cut locus); what is left of
/// one where the other end lies in its shadow. @param parted: take fronts that overlap as meeting.
inline FrontArrival blend_fronts(const Front& left, const Front& right, const EdgeSight& o, bool parted) {
    using namespace front_blend;
    FrontArrival result;
    FrontPoint a, b;
    const bool a_sees = place_centre(left, o.out - left.back, a);
    const bool b_sees = place_centre(right, right.back - o.home, b);
    b.x = o.length - b.x;
    const float tolerance = 1e-5F * o.length;
    // Almost half of the time both rays pass the same end: the way to the point leads over another edge.
    const float a_depth = a.y + o.y, b_depth = b.y + o.y;
    const float a_place = a.x * o.y + o.x * a.y, b_place = b.x * o.y + o.x * b.y;
    const float low = o.begin - tolerance, high = o.finish + tolerance;
    if (a_sees && b_sees &&
        ((a_place < low * a_depth && b_place < low * b_depth) ||
         (a_place > high * a_depth && b_place > high * b_depth))) {
        return result;
    }
    const auto is_seen = [&](float x) { return x >= o.begin - tolerance && x <= o.finish + tolerance; };
    const float a_cross = a_place / a_depth, b_cross = b_place / b_depth;
    const bool a_valid = a_sees && is_seen(a_cross), b_valid = b_sees && is_seen(b_cross);
    const bool same = left.label == right.label;
    // How far each front misses the other's end. One that is too short there has been cut off on its way.
    const float miss_b = left.offset + distance_between(o.length - a.x, a.y) - right.distance;
    const float miss_a = right.offset + distance_between(b.x, b.y) - left.distance;
    const float miss = std::max(std::fabs(miss_a), std::fabs(miss_b));
    result.miss = a_sees && b_sees && same ? miss : o.length;
    if (!a_valid && !b_valid) {
        return result;
    }
    const float a_reach = left.offset + distance_between(o.x - a.x, o.y + a.y);
    const float b_reach = right.offset + distance_between(o.x - b.x, o.y + b.y);
    const float xa = clamp_unit(a_cross / o.length), xb = clamp_unit(b_cross / o.length);
    const bool overlap = std::min(miss_a, miss_b) >= -agreeing * miss;
    const bool gap = std::max(miss_a, miss_b) <= agreeing * miss;
    if (a_sees && b_sees && same && (overlap || miss < (gap ? gap_last : shadow_last) * o.length)) {
        const float fall = 1 + xa - xb;
        float x = fall > 0.01F ? xa / fall : 0.5F * (xa + xb);
        x = x <= 1 ? x : 0.5F * (xa + xb);
        result.centre = {(1 - x) * a.x + x * b.x, (1 - x) * a.y + x * b.y};
        if (!is_seen(crossing(result.centre, o.x, o.y))) {
            return result;
        }
        // Half the sum of the misses is what a straight blend is too long by, were curvature spread evenly.
        result.distance = (1 - x) * a_reach + x * b_reach - 0.5F * x * (1 - x) * (miss_a + miss_b);
        result.label = left.label;
        if (!overlap) {
            return result;
        }
        // A front that agrees with the other end as well holds all along the edge.
        const float skew =
            std::min(1.0F, std::fabs(miss_a - miss_b) / (std::fabs(miss_a + miss_b) + 1e-9F * o.length));
        const float apart =
            parted ? 1.0F : clamp_unit((miss / o.length - overlap_first) / overlap_range + skew * skew);
        const bool a_nearer = a_valid && (!b_valid || a_reach <= b_reach);
        result.distance += apart * ((a_nearer ? a_reach : b_reach) - result.distance);
        if (apart > 0.5F) {
            result.centre = a_nearer ? a : b;
        }
        return result;
    }
    const float a_cut =
        a_valid ? a_reach + (same ? std::max(0.0F, -miss_b) * xa * xa : 0) : FrontArrival::never;
    const float b_cut =
        b_valid ? b_reach + (same ? std::max(0.0F, -miss_a) * (1 - xb) * (1 - xb) : 0) : FrontArrival::never;
    const bool a_nearer = a_cut <= b_cut;
    result.distance = a_nearer ? a_cut : b_cut;
    result.centre = a_nearer ? a : b;
    result.label = a_nearer ? left.label : right.label;
    return result;
}

} // namespace anvil
