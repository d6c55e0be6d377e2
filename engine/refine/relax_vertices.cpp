#include "engine/refine/relax_vertices.h"

#include "engine/mesh/triangle_angles.h"

#include <numeric>

namespace anvil {

namespace {

constexpr int most_sweeps = 20;
// Gains below this, in radians, are not worth another sweep.
constexpr double least_gain = 1e-3;
// Places tried between the parents; the best one's surroundings are then tried once more.
constexpr int tries = 24;
// A move that breaks the tolerance is tried again over this share of its way, down to the least one.
constexpr double shorter = 0.4;
constexpr double least_way = 0.05;

/// The faces around each vertex.
struct Stars {
    std::vector<uint32_t> begin;
    std::vector<uint32_t> faces;

    Stars(std::span<const EdgeMesh::Face> all, size_t vertex_count) : begin(vertex_count + 1, 0) {
        for (const EdgeMesh::Face& face : all) {
            for (const uint32_t v : face.corners) {
                ++begin[v + 1];
            }
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<uint32_t> cursor(begin.begin(), begin.end() - 1);
        faces.resize(begin.back());
        for (uint32_t f = 0; f < all.size(); ++f) {
            for (const uint32_t v : all[f].corners) {
                faces[cursor[v]++] = f;
            }
        }
    }

    std::span<const uint32_t> of(uint32_t v) const {
        return {faces.data() + begin[v], faces.data() + begin[v + 1]};
    }
};

struct Move {
    uint32_t vertex;
    double place;
    double before; ///< the place that it leaves
    double gain;
};

class Relaxer {
  public:
    Relaxer(RefineState& state, std::span<const EdgeMesh::Face> faces, const RelaxRules& rules)
        : state_(state), faces_(faces), rules_(rules), stars_(faces, state.positions.size()),
          first_(state.positions.size() - state.parents.size()), active_(state.positions.size(), 0) {
        for (size_t v = first_; v < active_.size(); ++v) {
            active_[v] = rules.fixed[v] == 0 ? 1 : 0;
        }
        for (const VertexParents& parents : state.parents) {
            active_[parents.a] = active_[parents.b] = 0;
        }
        movable_ = active_;
        ways_.assign(active_.size(), 1);
    }

    double run() {
        for (int sweep = 0; sweep < most_sweeps && move_some(); ++sweep) {
        }
        return largest_error_;
    }

  private:
    bool move_some() {
        std::vector<Move> moves;
        for (auto v = static_cast<uint32_t>(first_); v < active_.size(); ++v) {
            if (active_[v]) {
                consider(v, moves);
            }
        }
        std::sort(moves.begin(), moves.end(), [](const Move& x, const Move& y) {
            return x.gain != y.gain ? x.gain > y.gain : x.vertex < y.vertex;
        });
        keep_apart(moves);
        apply(moves);
        return !moves.empty();
    }

    const VertexParents& parents_of(uint32_t v) const { return state_.parents[v - first_]; }

    /// The place with the largest least angle; the vertex rests until a neighbour moves if it gains nothing.
    void consider(uint32_t v, std::vector<Move>& moves) {
        const VertexParents& parents = parents_of(v);
        Move best{v, parents.place, parents.place, 0};
        const double now = least_angle_at(v, parents.place);
        const auto try_places = [&](double from, double to) {
            for (int i = 1; i < tries; ++i) {
                const double place = from + (to - from) * i / tries;
                const double gain = least_angle_at(v, place) - now;
                best = gain > best.gain ? Move{v, place, parents.place, gain} : best;
            }
        };
        try_places(0, 1);
        const double around = 1.0 / tries;
        try_places(std::max(0.0, best.place - around), std::min(1.0, best.place + around));
        active_[v] = 0;
        if (ways_[v] < 1) {
            best.place = best.before + ways_[v] * (best.place - best.before);
            best.gain = least_angle_at(v, best.place) - now;
        }
        if (best.gain > least_gain) {
            moves.push_back(best);
        }
    }

    /// Of all angles of the faces around v with v at the place; negative where one would turn over.
    double least_angle_at(uint32_t v, double place) {
        const VertexParents& parents = parents_of(v);
        const Vec3 kept = state_.positions[v];
        const Vec3 there = between(state_.positions[parents.a], state_.positions[parents.b], place);
        double least = infinity;
        for (const uint32_t f : stars_.of(v)) {
            const Vec3 up = normal_of(faces_[f].corners);
            state_.positions[v] = there;
            const Triangle& t = faces_[f].corners;
            const auto& p = state_.positions;
            const double angle = least_angle_of(p[t[0]], p[t[1]], p[t[2]]);
            least = std::min(least, glm::dot(normal_of(t), up) > 0 ? angle : -1);
            state_.positions[v] = kept;
        }
        return least;
    }

    Vec3 normal_of(const Triangle& t) const {
        const auto& p = state_.positions;
        return glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    }

    /// Of neighbours the one that gains most; the others are looked at again.
    void keep_apart(std::vector<Move>& moves) {
        std::vector<char> taken(faces_.size(), 0);
        moves.erase(std::remove_if(moves.begin(), moves.end(),
                                   [&](const Move& move) {
                                       const auto star = stars_.of(move.vertex);
                                       const bool meets =
                                           std::any_of(star.begin(), star.end(),
                                                       [&](uint32_t f) { return taken[f] != 0; });
                                       for (const uint32_t f : star) {
                                           taken[f] = meets ? taken[f] : 1;
                                       }
                                       active_[move.vertex] = meets ? 1 : 0;
                                       return meets;
                                   }),
                    moves.end());
    }

    /// Takes back the moves after which an edge misses the tolerance.
    void apply(std::vector<Move>& moves) {
        std::vector<uint32_t> vertices;
        std::vector<EdgeSpan> spokes;
        std::vector<size_t> move_of;
        for (const Move& move : moves) {
            state_.move_vertex(move.vertex, move.place);
            vertices.push_back(move.vertex);
        }
        rules_.criterion->vertices_moved(state_, vertices);
        for (size_t i = 0; i < moves.size(); ++i) {
            for (const uint32_t other : neighbours_of(moves[i].vertex)) {
                const uint32_t v = moves[i].vertex;
                spokes.push_back({v, other, glm::distance(state_.positions[v], state_.positions[other])});
                move_of.push_back(i);
            }
        }
        const auto findings = rules_.criterion->measure(state_, spokes, rules_.tolerance);
        std::vector<double> errors(moves.size(), 0);
        for (size_t i = 0; i < spokes.size(); ++i) {
            errors[move_of[i]] = std::max(errors[move_of[i]], findings[i].error.error);
        }
        settle(moves, errors);
    }

    void settle(const std::vector<Move>& moves, const std::vector<double>& errors) {
        std::vector<uint32_t> returned;
        for (size_t i = 0; i < moves.size(); ++i) {
            const uint32_t v = moves[i].vertex;
            if (errors[i] > rules_.tolerance) {
                state_.move_vertex(v, moves[i].before);
                returned.push_back(v);
                ways_[v] *= shorter;
                active_[v] = ways_[v] >= least_way ? 1 : 0;
                continue;
            }
            largest_error_ = std::max(largest_error_, errors[i]);
            for (const uint32_t other : neighbours_of(v)) {
                active_[other] = movable_[other];
            }
        }
        rules_.criterion->vertices_moved(state_, returned);
    }

    std::vector<uint32_t> neighbours_of(uint32_t v) const {
        std::vector<uint32_t> others;
        for (const uint32_t f : stars_.of(v)) {
            for (const uint32_t other : faces_[f].corners) {
                if (other != v) {
                    others.push_back(other);
                }
            }
        }
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        return others;
    }

    RefineState& state_;
    std::span<const EdgeMesh::Face> faces_;
    const RelaxRules& rules_;
    Stars stars_;
    size_t first_;              ///< vertex that is new
    std::vector<char> active_;  ///< per vertex: whether it may gain by a move
    std::vector<char> movable_; ///< per vertex: whether it may move at all
    std::vector<double> ways_;  ///< per vertex: the share of the way to its best place that it may go
    double largest_error_ = 0;
};

} // namespace

double relax_vertices(RefineState& state, std::span<const EdgeMesh::Face> faces, const RelaxRules& rules) {
    return Relaxer(state, faces, rules).run();
}

} // namespace anvil
