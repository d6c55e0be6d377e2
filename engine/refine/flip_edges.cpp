#include "engine/refine/flip_edges.h"

#include "engine/mesh/triangle_angles.h"

#include <set>
#include <tuple>

namespace anvil {

namespace {

constexpr int most_sweeps = 50;
// Gains below this, in radians, are rounding.
constexpr double least_gain = 1e-9;

struct Side {
    uint32_t root, low, high, face, corner;

    auto key() const { return std::tuple(root, low, high); }
};

struct Flip {
    uint32_t face, other; ///< (a, b, c) and (b, a, d)
    uint32_t a, b, c, d;
    double gain;
};

class Flipper {
  public:
    Flipper(std::vector<EdgeMesh::Face>& faces, std::span<const Vec3> positions, const FlipRules& rules)
        : faces_(faces), p_(positions), rules_(rules) {}

    double run() {
        for (int sweep = 0; sweep < most_sweeps && flip_some(); ++sweep) {
        }
        return largest_error_;
    }

  private:
    std::vector<Side> sorted_sides() const {
        std::vector<Side> sides;
        sides.reserve(3 * faces_.size());
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            for (uint32_t i = 0; i < 3; ++i) {
                const auto [low, high] =
                    std::minmax(faces_[f].corners[i], faces_[f].corners[i == 2 ? 0 : i + 1]);
                sides.push_back({faces_[f].root, low, high, f, i});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) { return x.key() < y.key(); });
        return sides;
    }

    bool flip_some() {
        const std::vector<Side> sides = sorted_sides();
        std::vector<Flip> flips;
        for (size_t i = 0; i + 1 < sides.size(); ++i) {
            if (sides[i].key() == sides[i + 1].key()) {
                consider(sides[i], sides[i + 1], flips);
            }
        }
        std::sort(flips.begin(), flips.end(), [](const Flip& x, const Flip& y) {
            return x.gain != y.gain ? x.gain > y.gain : x.face < y.face;
        });
        keep_apart(flips);
        return apply(flips);
    }

    void consider(const Side& side, const Side& twin, std::vector<Flip>& flips) const {
        const Triangle& t = faces_[side.face].corners;
        const Triangle& u = faces_[twin.face].corners;
        const uint32_t a = t[side.corner];
        const uint32_t b = t[(side.corner + 1) % 3];
        const uint32_t c = t[(side.corner + 2) % 3];
        const uint32_t d = u[(twin.corner + 2) % 3];
        if (u[twin.corner] != b || c == d || rules_.is_fixed(a, b) || refused_.count(std::minmax(c, d)) > 0) {
            return;
        }
        const Vec3 up = glm::cross(p_[b] - p_[a], p_[c] - p_[a]);
        const bool convex = glm::dot(up, glm::cross(p_[d] - p_[a], p_[c] - p_[a])) > 0 &&
                            glm::dot(up, glm::cross(p_[b] - p_[d], p_[c] - p_[d])) > 0;
        const double gain = std::min(least_angle(a, d, c), least_angle(d, b, c)) -
                            std::min(least_angle(a, b, c), least_angle(b, a, d));
        if (convex && gain > least_gain) {
            flips.push_back({side.face, twin.face, a, b, c, d, gain});
        }
    }

    double least_angle(uint32_t a, uint32_t b, uint32_t c) const {
        return least_angle_of(p_[a], p_[b], p_[c]);
    }

    /// Of flips that share a face, the one that gains most.
    void keep_apart(std::vector<Flip>& flips) const {
        std::vector<char> taken(faces_.size(), 0);
        flips.erase(std::remove_if(flips.begin(), flips.end(),
                                   [&](const Flip& flip) {
                                       const bool meets = taken[flip.face] || taken[flip.other];
                                       taken[flip.face] = taken[flip.other] = 1;
                                       return meets;
                                   }),
                    flips.end());
    }

    bool apply(const std::vector<Flip>& flips) {
        std::vector<EdgeSpan> edges;
        edges.reserve(flips.size());
        for (const Flip& flip : flips) {
            edges.push_back({flip.c, flip.d, glm::distance(p_[flip.c], p_[flip.d])});
        }
        const std::vector<double> errors = rules_.errors(edges);
        for (size_t i = 0; i < flips.size(); ++i) {
            const Flip& flip = flips[i];
            if (errors[i] > rules_.tolerance) {
                refused_.insert(std::minmax(flip.c, flip.d));
                continue;
            }
            const uint32_t root = faces_[flip.face].root;
            const Triangle none{no_index, no_index, no_index};
            faces_[flip.face] = {{flip.a, flip.d, flip.c}, none, root};
            faces_[flip.other] = {{flip.d, flip.b, flip.c}, none, root};
            largest_error_ = std::max(largest_error_, errors[i]);
        }
        // Also where all were refused: others may then be the best of their faces.
        return !flips.empty();
    }

    std::vector<EdgeMesh::Face>& faces_;
    std::span<const Vec3> p_;
    const FlipRules& rules_;
    std::set<std::pair<uint32_t, uint32_t>> refused_; ///< edges that would miss the tolerance
    double largest_error_ = 0;
};

} // namespace

double flip_edges(std::vector<EdgeMesh::Face>& faces, std::span<const Vec3> positions,
                  const FlipRules& rules) {
    return Flipper(faces, positions, rules).run();
}

} // namespace anvil
