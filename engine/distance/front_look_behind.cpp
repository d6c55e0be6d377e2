#include "engine/distance/front_look_behind.h"

namespace anvil {
namespace {

using namespace front_blend;

// Deeper changes little: what is still seen of an edge is small by then.
constexpr int most_levels = 4;
constexpr float shadow_turn = 3.14159F; // a little less than pi

FrontPoint operator-(const FrontPoint& a, const FrontPoint& b) {
    return {a.x - b.x, a.y - b.y};
}

float cross(const FrontPoint& a, const FrontPoint& b) {
    return a.x * b.y - a.y * b.x;
}

float dot(const FrontPoint& a, const FrontPoint& b) {
    return a.x * b.x + a.y * b.y;
}

} // namespace

bool is_in_shadow(const Front& front, float direction) {
    const float turn = std::fabs(direction - front.back);
    return turn >= shadow_turn && front.total - turn >= shadow_turn;
}

/// An edge that the point looks over, in the frame of the first one.
struct LookBehind::Edge {
    uint32_t left, right;
    FrontPoint at_left, at_right;
    float length, out, home; ///< as in EdgeSight
    uint32_t home_spoke;     ///< from right to left, the triangle behind counterclockwise of it; or no_index
};

/// What the point sees: everything between the rays through these two.
struct LookBehind::Wedge {
    FrontPoint eye, left, right;
};

uint32_t LookBehind::spoke_to(uint32_t vertex, uint32_t other, float direction) const {
    const float total = fronts_[vertex].total;
    if (total == Fan::tangled) {
        return no_index;
    }
    uint32_t best = no_index;
    float least = FrontArrival::never;
    for (uint32_t i = fronts_[vertex].first_spoke; i < fronts_[vertex + 1].first_spoke; ++i) {
        const Spoke& spoke = table_.spokes[i];
        if (spoke.vertex == other) {
            const float off = std::fabs(spoke.direction - direction);
            const float around = std::min(off, std::fabs(total - off));
            best = around < least ? i : best;
            least = std::min(around, least);
        }
    }
    return best;
}

FrontArrival LookBehind::best_way(uint32_t left, uint32_t right, const EdgeSight& sight) const {
    FrontArrival best;
    const uint32_t home_spoke = spoke_to(right, left, sight.home);
    if (home_spoke != no_index) {
        const FrontPoint at_left{0, 0}, at_right{sight.length, 0};
        behind({left, right, at_left, at_right, sight.length, sight.out, sight.home, home_spoke},
               {{sight.x, sight.y}, at_left, at_right}, most_levels, best);
    }
    return best;
}

/// Ways over the seen part of the edge.
void LookBehind::through(const Edge& edge, const Wedge& wedge, int levels, FrontArrival& best) const {
    if (!(edge.length > 0)) {
        return;
    }
    const FrontPoint span = edge.at_right - edge.at_left;
    const FrontPoint e{span.x / edge.length, span.y / edge.length};
    const FrontPoint eye = wedge.eye - edge.at_left;
    EdgeSight sight{edge.length, dot(eye, e), cross(e, eye), edge.out, edge.home, 0, edge.length};
    if (!(sight.y > 0)) {
        return;
    }
    // Where the ray through a rim of the wedge meets the edge.
    const auto cut = [&](const FrontPoint& rim, float otherwise) {
        const FrontPoint ray = rim - wedge.eye;
        const float down = -cross(e, ray);
        return down > 0 ? std::clamp(sight.x + dot(ray, e) * sight.y / down, 0.0F, edge.length) : otherwise;
    };
    sight.begin = cut(wedge.left, 0);
    sight.finish = cut(wedge.right, edge.length);
    const Front &left = fronts_[edge.left], &right = fronts_[edge.right];
    FrontArrival here = blend_fronts(left, right, sight, false);
    if (here.miss > fronts_agree * std::min(left.distance, right.distance)) {
        if (levels > 1 && edge.home_spoke != no_index) {
            FrontArrival deeper;
            behind(edge, wedge, levels - 1, deeper);
            if (deeper.distance < FrontArrival::never) {
                best = deeper.distance < best.distance ? deeper : best;
                return;
            }
        }
        // Nothing evens out over so small a part.
        here = blend_fronts(left, right, sight, true);
    }
    if (here.distance < best.distance) {
        best = here;
        best.centre = {edge.at_left.x + e.x * here.centre.x + e.y * here.centre.y,
                       edge.at_left.y + e.y * here.centre.x - e.x * here.centre.y};
    }
}

/// Ways through the triangle behind the edge: over its two other sides, or bent at its third corner.
void LookBehind::behind(const Edge& edge, const Wedge& wedge, int levels, FrontArrival& best) const {
    const Spoke& to_left = table_.spokes[edge.home_spoke];
    const uint32_t onward = next_spoke(edge.right, edge.home_spoke);
    const Spoke& to_apex = table_.spokes[onward];
    const uint32_t apex = to_apex.vertex;
    if (to_left.sine < 0 || !is_known(apex)) {
        return;
    }
    const uint32_t apex_home = spoke_to(apex, edge.right, to_apex.back);
    if (apex_home == no_index) {
        return;
    }
    const float scale = to_apex.length / edge.length;
    const FrontPoint base = edge.at_left - edge.at_right;
    const FrontPoint at_apex{edge.at_right.x + scale * (to_left.cosine * base.x - to_left.sine * base.y),
                             edge.at_right.y + scale * (to_left.sine * base.x + to_left.cosine * base.y)};
    const FrontPoint ray = at_apex - wedge.eye;
    const bool sees_left_side = cross(wedge.left - wedge.eye, ray) > 0;
    const bool sees_right_side = cross(wedge.right - wedge.eye, ray) < 0;
    if (sees_left_side) {
        const uint32_t apex_to_left = next_spoke(apex, apex_home);
        const Spoke& side = table_.spokes[apex_to_left];
        through(
            {edge.left, apex, edge.at_left, at_apex, side.length, side.back, side.direction, apex_to_left},
            {wedge.eye, wedge.left, sees_right_side ? at_apex : wedge.right}, levels, best);
    }
    if (sees_right_side) {
        through({apex, edge.right, at_apex, edge.at_right, to_apex.length, to_apex.back, to_apex.direction,
                 onward},
                {wedge.eye, sees_left_side ? at_apex : wedge.left, wedge.right}, levels, best);
    }
    if (sees_left_side && sees_right_side) {
        bend_at(apex, to_apex.back, at_apex, edge.at_right, wedge.eye, best);
    }
}

void LookBehind::bend_at(uint32_t vertex, float towards_right, const FrontPoint& at, const FrontPoint& right,
                         const FrontPoint& eye, FrontArrival& best) const {
    const Front& front = fronts_[vertex];
    const FrontPoint to_eye = eye - at, to_right = right - at;
    float direction =
        towards_right + half_turn_angle(dot(to_right, to_eye), std::max(0.0F, cross(to_right, to_eye)));
    direction -= direction > front.total ? front.total : 0;
    const float distance = front.distance + distance_between(to_eye.x, to_eye.y);
    if (distance < best.distance && (front.distance <= front.offset || is_in_shadow(front, direction))) {
        best.distance = distance;
        best.centre = at;
        best.label = front.label;
    }
}

} // namespace anvil
