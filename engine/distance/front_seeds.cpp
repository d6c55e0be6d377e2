#include "engine/distance/front_seeds.h"

namespace anvil {
namespace {

using Vec2 = glm::dvec2;

// Mean edges to the centre of a line's front: it bends by 1e-3 over an edge, and float keeps 2e-5 of the
// edge.
constexpr double flat_front = 300;

double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Angle from a counterclockwise to b, in [0, pi] up to rounding.
double angle_between(const Vec2& a, const Vec2& b) {
    return std::atan2(std::max(0.0, cross(a, b)), glm::dot(a, b));
}

/// Direction of a side of the input surface at its vertex; 0 at vertices without directions.
double direction_of(const TriangleGraph& graph, uint32_t side) {
    const uint32_t vertex = graph.from(side);
    const FanShape shape = fan_shape(graph, vertex, graph.sides_leaving(vertex).front());
    if (shape.kind == FanShape::Kind::tangled) {
        return 0;
    }
    double direction = 0;
    for (uint32_t s = shape.first; s != side; s = graph.twin(TriangleGraph::previous(s))) {
        direction += corner_angle(graph, s);
    }
    return direction;
}

/// Walks straight from a vertex to a source over the triangles of the table, unfolded into one plane, and
/// seeds the corners of the one where the source lies.
class Walk {
  public:
    Walk(const FanTable& table, const FrontSeed& start, std::vector<FrontSeed>& seeds)
        : table_(table), label_(start.label), seeds_(seeds) {
        const Fan& fan = table.fans[start.vertex];
        for (uint32_t i = fan.first_spoke; fan.total != Fan::tangled && i < end(start.vertex); ++i) {
            const Spoke& p = table.spokes[i];
            const double corner = std::atan2(p.sine, p.cosine);
            double angle = start.direction - p.direction;
            angle += angle < -1e-5 ? fan.total : 0;
            if (p.sine >= 0 && angle <= corner + 1e-5) {
                source_ = static_cast<double>(start.distance) * Vec2(std::cos(angle), std::sin(angle));
                step_into(start.vertex, i, Vec2(0), Vec2(p.length, 0), 0);
                return;
            }
        }
    }

  private:
    static constexpr int most_steps = 64;

    uint32_t end(uint32_t vertex) const { return table_.fans[vertex + 1].first_spoke; }
    uint32_t next(uint32_t vertex, uint32_t spoke) const {
        return spoke + 1 < end(vertex) ? spoke + 1 : table_.fans[vertex].first_spoke;
    }

    /// The spoke of the same edge at its other end, no_index at vertices without directions.
    uint32_t back_spoke(uint32_t vertex, uint32_t spoke) const {
        const Spoke& out = table_.spokes[spoke];
        const Fan& fan = table_.fans[out.vertex];
        uint32_t best = no_index;
        float least = infinity;
        for (uint32_t i = fan.first_spoke; fan.total != Fan::tangled && i < end(out.vertex); ++i) {
            float off = std::fabs(table_.spokes[i].direction - out.back);
            off = std::min(off, std::fabs(fan.total - off));
            if (table_.spokes[i].vertex == vertex && off < least) {
                least = off;
                best = i;
            }
        }
        return best;
    }

    /// The triangle counterclockwise of the spoke w -> u, whose ends lie at `at_w` and `at_u`.
    void step_into(uint32_t w, uint32_t spoke, const Vec2& at_w, const Vec2& at_u, int steps) {
        const Spoke& to_u = table_.spokes[spoke];
        const uint32_t onward = next(w, spoke);
        const Spoke& to_x = table_.spokes[onward];
        const uint32_t x_home = back_spoke(w, onward);
        if (steps == most_steps || to_u.sine < 0 || x_home == no_index || !(to_u.length > 0)) {
            return;
        }
        const Vec2 base = (at_u - at_w) * (static_cast<double>(to_x.length) / to_u.length);
        const Vec2 at_x =
            at_w + Vec2(to_u.cosine * base.x - to_u.sine * base.y, to_u.sine * base.x + to_u.cosine * base.y);
        if (cross(at_w - at_x, source_ - at_x) < 0) {
            step_into(w, onward, at_w, at_x, steps + 1);
            return;
        }
        if (cross(at_x - at_u, source_ - at_u) < 0) {
            step_into(to_x.vertex, next(to_x.vertex, x_home), at_x, at_u, steps + 1);
            return;
        }
        seed(w, at_w, to_u.direction + angle_between(at_u - at_w, source_ - at_w));
        seed(to_u.vertex, at_u, to_u.back - angle_between(source_ - at_u, at_w - at_u));
        seed(to_x.vertex, at_x, table_.spokes[x_home].direction + angle_between(at_w - at_x, source_ - at_x));
    }

    void seed(uint32_t vertex, const Vec2& at, double direction) {
        seeds_.push_back({vertex, label_, static_cast<float>(glm::length(source_ - at)),
                          static_cast<float>(direction), 0});
    }

    const FanTable& table_;
    uint32_t label_;
    std::vector<FrontSeed>& seeds_;
    Vec2 source_{0};
};

} // namespace

std::vector<FrontSeed> front_seeds(const TriangleGraph& graph, const FanTable& table,
                                   std::span<const Seed> seeds) {
    std::vector<FrontSeed> fronts;
    for (const Seed& seed : seeds) {
        const double direction = seed.side == no_index ? 0 : direction_of(graph, seed.side) + seed.angle;
        const double offset = seed.of_line ? -flat_front * table.mean_length : 0;
        fronts.push_back({seed.vertex, seed.label, static_cast<float>(seed.distance),
                          static_cast<float>(direction), static_cast<float>(offset)});
    }
    const size_t given = fronts.size();
    for (size_t i = 0; i < given; ++i) {
        // One walk a source is enough: from its first corner.
        if (seeds[i].side != no_index && !seeds[i].of_line &&
            (i == 0 || seeds[i - 1].label != seeds[i].label)) {
            const FrontSeed start = fronts[i];
            Walk(table, start, fronts);
        }
    }
    return fronts;
}

} // namespace anvil
