#include "engine/distance/vertex_fronts.h"

#include "engine/distance/front_look_behind.h"

namespace anvil {
namespace {

using namespace front_blend;

// Chosen by trial on meshes of all kinds; errors change little around them.
constexpr double bucket_width = 0.1; // mean edges
constexpr float least_gain = 1e-5F;  // relative; less is rounding and not worth another march
constexpr float provisional_slack = 1e-6F;
constexpr float too_late = 0.6F; // of the corner's sides: how far behind the front is still worth a look
// A path along an edge waits by this part of the edge: the front that really passes there points better.
constexpr float edge_delay = 0.35F;
constexpr float curved_front = 3; // edges: nearer to its centre a front may come from beyond an acute corner

// A path along an edge turns fully where it bends by this at a boundary, or where the angle around a vertex
// exceeds 2 pi by it (radians); chosen by trial.
constexpr float boundary_bend = 0.3F;
constexpr float full_bend = 0.3F;

constexpr uint32_t settled_bit = 1;
constexpr uint32_t provisional_bit = 2; // came along an edge that may just graze the true way
constexpr uint32_t hasty_bit = 4;       // has marched while provisional
constexpr uint32_t march_step = 8;
// Up to 15 marches a vertex and run, so that nothing goes round for ever. On the 41 meshes of
// bench_distance_errors 7 or 500 give the same numbers to the last digit; 3 raise the mean error of four of
// them, by a tenth at most.
constexpr uint32_t run_step = 128;
constexpr uint32_t most_repairs = 8;

} // namespace

/// The corner of a triangle opposite to an edge A-B, in the frame A = (0,0), B = (length,0).
struct VertexFronts::Opposite {
    uint32_t other, corner;
    float length, x, y;
    float out;         ///< direction of AB at A
    float home;        ///< direction of BA at B
    float corner_back; ///< direction of CA at the corner
    float turn;        ///< 1 if the triangle lies counterclockwise of AB at A, else -1
};

VertexFronts::VertexFronts(const FanTable& table)
    : table_(table), fronts_(table.fans.size()),
      queue_(bucket_width * table.mean_length, 2 * table.longest + table.mean_length) {
    for (size_t v = 0; v < fronts_.size(); ++v) {
        fronts_[v].total = table.fans[v].total;
        fronts_[v].first_spoke = table.fans[v].first_spoke;
    }
    slack_ = static_cast<float>(table.mean_length);
}

/// A vertex that is reached marches soon: its spokes are on their way from the memory by then. Waiting for
/// them, and for the fronts at their ends, was a fifth of the time of a march.
void VertexFronts::fetch_spokes(const Front& front) const {
    constexpr uint32_t spokes_a_line = 64 / sizeof(Spoke) + 1;
    for (uint32_t i = 0; i < 3; ++i) { // as much as six or seven spokes take
        __builtin_prefetch(table_.spokes.data() + front.first_spoke + i * spokes_a_line);
    }
}

void VertexFronts::fetch_around_next() const {
    for (uint32_t further = 1; further <= 3; ++further) {
        const Waiting* const next = queue_.ahead(further);
        if (next == nullptr) {
            return;
        }
        const Front& front = fronts_[next->vertex];
        if (front.distance == next->distance && !is_settled(front)) {
            const uint32_t end = fronts_[next->vertex + 1].first_spoke;
            for (uint32_t i = front.first_spoke; i < end; ++i) {
                __builtin_prefetch(&fronts_[table_.spokes[i].vertex]);
            }
            return;
        }
    }
}

void VertexFronts::accept(uint32_t vertex, float distance, float offset, float direction, uint32_t label,
                          uint32_t parents, float delay) {
    Front& front = fronts_[vertex];
    if (!is_reached(front)) {
        reached_.push_back(vertex);
        front.stamp = run_stamp_;
        fetch_spokes(front);
    } else if (front.stamp + 2 * march_step >= run_stamp_ + run_step) {
        return;
    }
    front.stamp &= ~(settled_bit | provisional_bit);
    front.distance = distance;
    front.offset = front.total == Fan::tangled ? distance : offset;
    front.label = label;
    front.parents = parents;
    if (direction >= front.total) {
        direction -= front.total;
    }
    if (direction < 0 && front.total < Fan::open) {
        direction += front.total;
    }
    front.back = direction;
    queue_.push(distance + delay, {distance, vertex});
}

void VertexFronts::update(uint32_t from, const Opposite& o) {
    const Front& c = fronts_[o.corner];
    const float known = is_reached(c) ? c.distance : FrontArrival::never;
    const bool from_left = o.turn > 0;
    const uint32_t left = from_left ? from : o.other, right = from_left ? o.other : from;
    const float x = from_left ? o.x : o.length - o.x;
    const EdgeSight sight{o.length, x,       o.y, from_left ? o.out : o.home, from_left ? o.home : o.out,
                          0,        o.length};
    FrontArrival way = blend_fronts(fronts_[left], fronts_[right], sight, false);
    way.centre.y = -way.centre.y;
    // What has marched already has had its closer look.
    if (is_reached(c) && is_settled(c) && way.distance >= known) {
        return;
    }
    if (way.miss > fronts_agree * std::min(fronts_[left].distance, fronts_[right].distance)) {
        const LookBehind look(table_, fronts_, run_stamp_, settled_bit);
        const FrontArrival deeper = look.best_way(left, right, sight);
        way = deeper.distance < FrontArrival::never ? deeper : way;
    }
    // A path along an edge that is hardly too long still points the centre wrong, by the root of its excess.
    const float needed_gain = (c.stamp & provisional_bit) != 0 ? -provisional_slack : least_gain;
    if (way.distance < known * (1 - needed_gain) && way.distance >= least_) {
        const float wx = way.centre.x - x, wy = way.centre.y - o.y;
        // From the way back to `from` around to the centre.
        const float fx = from_left ? -x : o.length - x, fy = -o.y;
        const float across = std::max(0.0F, o.turn * (fx * wy - fy * wx)), along = fx * wx + fy * wy;
        accept(o.corner, way.distance, way.distance - distance_between(wx, wy),
               o.corner_back + o.turn * half_turn_angle(along, across), way.label, from ^ o.other);
    }
}

void VertexFronts::follow_edge(uint32_t from, const Spoke& spoke) {
    const Front& a = fronts_[from];
    const Front& c = fronts_[spoke.vertex];
    const float distance = a.distance + spoke.length;
    if (distance < least_ || (is_reached(c) && distance >= c.distance * (1 - least_gain))) {
        return;
    }
    const bool straight = a.distance <= a.offset || is_in_shadow(a, spoke.direction);
    // A slight saddle re-aims the centre straight behind it, a strong one becomes the centre.
    const float bend = a.total == Fan::open
                           ? clamp_unit((std::fabs(spoke.direction - a.back) - pi) / boundary_bend)
                           : clamp_unit((a.total - 2 * pi) / full_bend);
    accept(spoke.vertex, distance, a.offset + (a.distance - a.offset) * bend, spoke.back, a.label, ~from,
           straight ? 0 : spoke.length * edge_delay);
    fronts_[spoke.vertex].stamp |= straight ? 0 : provisional_bit;
}

/// Whether a march from `a` may still lower the corner at (x, y) over an edge of the given length.
bool VertexFronts::may_lower(const Front& a, const Front& corner, float length, float x, float y) const {
    if (!is_reached(corner) || corner.distance > a.distance) {
        return true;
    }
    if (corner.distance < a.distance - too_late * (std::fabs(x) + y)) {
        return false;
    }
    const bool acute = x * (x - length) + y * y > 0;
    return !(acute && is_settled(corner) && a.distance - a.offset > curved_front * length);
}

// Flattened, what is known of an edge stays in registers from here to the blend of its fronts: a tenth of the
// time of a march.
[[gnu::flatten]] void VertexFronts::march_from(uint32_t vertex) {
    const Front& a = fronts_[vertex];
    const Spoke* const first = table_.spokes.data() + a.first_spoke;
    const Spoke* const end = table_.spokes.data() + fronts_[vertex + 1].first_spoke;
    if (first == end) {
        return;
    }
    const Spoke* p = first;
    const Front* p_front = &fronts_[p->vertex];
    for (; p != end; ++p) {
        const Spoke* q = p + 1 != end ? p + 1 : first;
        const Front* q_front = &fronts_[q->vertex];
        if (p->sine >= 0) {
            const bool p_known = is_reached(*p_front) && is_settled(*p_front);
            const bool q_known = is_reached(*q_front) && is_settled(*q_front);
            if (p_known) {
                const float x = q->length * p->cosine, y = q->length * p->sine;
                if (may_lower(a, *q_front, p->length, x, y)) {
                    update(vertex,
                           {p->vertex, q->vertex, p->length, x, y, p->direction, p->back, q->back, 1});
                }
            }
            if (q_known) {
                const float x = p->length * p->cosine, y = p->length * p->sine;
                if (may_lower(a, *p_front, q->length, x, y)) {
                    update(vertex,
                           {q->vertex, p->vertex, q->length, x, y, q->direction, q->back, p->back, -1});
                }
            }
        }
        p_front = q_front;
    }
    for (p = first; p != end; ++p) {
        follow_edge(vertex, *p);
    }
}

/// A vertex that marched before its own front was known has passed on values that may be too small; nothing
/// larger would replace them. Those that came from it are found again.
void VertexFronts::repair_around(uint32_t vertex) {
    const uint32_t first = fronts_[vertex].first_spoke, end = fronts_[vertex + 1].first_spoke;
    for (uint32_t i = first; i < end; ++i) {
        const uint32_t neighbour = table_.spokes[i].vertex;
        const uint32_t after = table_.spokes[i + 1 < end ? i + 1 : first].vertex;
        const uint32_t before = table_.spokes[i > first ? i - 1 : end - 1].vertex;
        const Front& c = fronts_[neighbour];
        const bool from_here =
            c.parents == ~vertex || c.parents == (vertex ^ after) || c.parents == (vertex ^ before);
        // As everywhere, what the front has passed stays, so that bounded runs agree with unbounded ones.
        if (from_here && is_reached(c) && c.distance >= least_ &&
            c.stamp % run_step < most_repairs * march_step) {
            find_again(neighbour);
        }
    }
}

/// The value of a vertex from all its settled neighbours, larger than before or not.
void VertexFronts::find_again(uint32_t vertex) {
    Front& c = fronts_[vertex];
    const Front before = c;
    c.distance = FrontArrival::never;
    c.stamp &= ~(settled_bit | provisional_bit);
    const auto settled = [&](const Front& front) { return is_reached(front) && is_settled(front); };
    const uint32_t first = c.first_spoke, end = fronts_[vertex + 1].first_spoke;
    for (uint32_t i = first; i < end; ++i) {
        const Spoke& p = table_.spokes[i];
        const Spoke& q = table_.spokes[i + 1 < end ? i + 1 : first];
        const Front& a = fronts_[p.vertex];
        const float dx = q.length * p.cosine - p.length, dy = q.length * p.sine;
        const float base = distance_between(dx, dy);
        if (p.sine < 0 || !(base > 0) || !settled(a) || !settled(fronts_[q.vertex])) {
            continue;
        }
        const float x = -p.length * dx / base, y = p.length * dy / base;
        float out = p.back - half_turn_angle(x, y), home = q.back + half_turn_angle(base - x, y);
        out += out < 0 && a.total < Fan::open ? a.total : 0;
        home -= home >= fronts_[q.vertex].total ? fronts_[q.vertex].total : 0;
        update(p.vertex, {q.vertex, vertex, base, x, y, out, home, p.direction, 1});
    }
    for (uint32_t i = first; i < end; ++i) {
        const Spoke& p = table_.spokes[i];
        if (settled(fronts_[p.vertex])) {
            follow_edge(p.vertex, {vertex, p.length, p.back, p.direction, 1, Spoke::no_corner});
        }
    }
    if (c.distance >= FrontArrival::never) {
        c = before;
    }
}

void VertexFronts::clear() {
    run_stamp_ += run_step;
    if (run_stamp_ >= no_index - run_step) {
        for (Front& front : fronts_) {
            front.stamp = 0;
        }
        run_stamp_ = run_step;
    }
    reached_.clear();
    queue_.clear();
    marched_ = 0;
}

void VertexFronts::add(std::span<const FrontSeed> seeds) {
    queue_.rewind();
    least_ = -1;
    for (const FrontSeed& seed : seeds) {
        const Front& front = fronts_[seed.vertex];
        if (!is_reached(front) || seed.distance < front.distance) {
            accept(seed.vertex, seed.distance, seed.offset, seed.direction, seed.label, ~seed.vertex);
        }
    }
}

void VertexFronts::grow(double radius) {
    queue_.open_until(radius + slack_);
    while (!queue_.empty()) {
        const Waiting next = queue_.pop();
        fetch_around_next();
        Front& front = fronts_[next.vertex];
        if (next.distance != front.distance || is_settled(front)) {
            continue;
        }
        // An unbounded run would go on here; what it still finds must not lie within the radius.
        least_ = static_cast<float>(static_cast<double>(queue_.current()) * queue_.width()) - slack_;
        const bool was_hasty = (front.stamp & hasty_bit) != 0;
        front.stamp &= ~hasty_bit;
        front.stamp |= (front.stamp & provisional_bit) != 0 ? hasty_bit : 0;
        front.stamp += march_step;
        front.stamp |= settled_bit;
        ++marched_;
        march_from(next.vertex);
        if (was_hasty) {
            repair_around(next.vertex);
        }
    }
}

} // namespace anvil
