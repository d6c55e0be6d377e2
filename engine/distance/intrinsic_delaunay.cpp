#include "engine/distance/intrinsic_delaunay.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel_for.h"
#include "engine/distance/unfold.h"

#include <functional>
#include <mutex>
#include <numeric>

namespace anvil {
namespace {

// Sums of cotangents above this are Delaunay up to rounding; flipping on less could go on for ever.
constexpr double flip_threshold = -1e-7;

class Flipper {
  public:
    explicit Flipper(IntrinsicGraph& graph)
        : graph_(graph), origins_(graph.vertex_count()), side_before_(graph.corner_vertex.size()),
          flipped_(graph.triangle_count()) {
        std::iota(side_before_.begin(), side_before_.end(), 0U);
        for (uint32_t v = 0; v < graph.vertex_count(); ++v) {
            if (!graph.sides_leaving(v).empty()) {
                origins_[v] = {graph.sides_leaving(v).front(), 0};
            }
        }
    }

    IntrinsicDelaunay run() {
        find_candidates();
        // Flips end by theory; the bound is for lengths that rounding has made contradictory.
        size_t left = 50 * graph_.corner_vertex.size();
        while (!candidates_.empty() && left-- > 0) {
            const uint32_t side = candidates_.back();
            candidates_.pop_back();
            const uint32_t twin = graph_.twin(side);
            if (twin < TriangleGraph::tangled && wants_flip(side, twin) && may_flip(side, twin)) {
                flip(side, twin);
            }
        }
        link_vertices(graph_, graph_.vertex_count());
        return {std::move(origins_), std::move(flipped_)};
    }

  private:
    void find_candidates() {
        std::mutex mutex;
        parallel_for(graph_.triangle_count(), 1 << 13, [&](size_t begin, size_t end) {
            std::vector<uint32_t> found;
            for (size_t t = begin; t < end; ++t) {
                const uint32_t side = longest_side(static_cast<uint32_t>(t));
                // Only sides opposite to an obtuse corner are ever flipped, of which a triangle has one.
                if (opposite_cosine(side) < 0) {
                    const uint32_t twin = graph_.twin(side);
                    const bool told_there =
                        twin < side && twin == longest_side(twin / 3) && opposite_cosine(twin) < 0;
                    if (twin < TriangleGraph::tangled && !told_there && wants_flip(side, twin)) {
                        found.push_back(std::min(side, twin));
                    }
                }
            }
            const std::scoped_lock lock(mutex);
            candidates_.insert(candidates_.end(), found.begin(), found.end());
        });
        // The order decides among equally good triangulations; threads must not.
        std::sort(candidates_.begin(), candidates_.end(), std::greater<>());
    }

    uint32_t longest_side(uint32_t triangle) const {
        const double* const length = &graph_.side_length[3 * size_t{triangle}];
        const uint32_t k = length[1] > length[0] ? 1 : 0;
        return 3 * triangle + (length[2] > length[k] ? 2 : k);
    }

    /// b^2 + c^2 - a^2 of the corner opposite the side: twice the product of its sides and its cosine.
    double opposite_cosine(uint32_t side) const {
        const double a = graph_.side_length[side];
        const double b = graph_.side_length[TriangleGraph::next(side)];
        const double c = graph_.side_length[TriangleGraph::previous(side)];
        return b * b + (c - a) * (c + a);
    }
    double four_areas(uint32_t side) const {
        return std::sqrt(sixteen_area_squared(graph_.side_length[side],
                                              graph_.side_length[TriangleGraph::next(side)],
                                              graph_.side_length[TriangleGraph::previous(side)]));
    }

    bool wants_flip(uint32_t side, uint32_t twin) const {
        const double near = opposite_cosine(side), far = opposite_cosine(twin);
        if (near >= 0 && far >= 0) {
            return false;
        }
        const double length = graph_.side_length[side];
        const double least = 1e-14 * length * length;
        const double near_area = four_areas(side), far_area = four_areas(twin);
        if (near_area <= 1e5 * least && far_area <= 1e5 * least) {
            return false; // two flat triangles: no diagonal is better
        }
        return near / std::max(near_area, least) + far / std::max(far_area, least) < flip_threshold;
    }

    bool may_flip(uint32_t side, uint32_t twin) const {
        const uint32_t one = side / 3, two = twin / 3;
        if (one == two || graph_.apex(side) == graph_.apex(twin)) {
            return false;
        }
        // Slots move in a flip; an edge that has both its sides in the two triangles could not be followed.
        for (const uint32_t s : {TriangleGraph::next(side), TriangleGraph::previous(side),
                                 TriangleGraph::next(twin), TriangleGraph::previous(twin)}) {
            for (uint32_t link = graph_.across[s]; link != no_index && link >> 1 != s;
                 link = graph_.across[link >> 1]) {
                if ((link >> 1) / 3 == one || (link >> 1) / 3 == two) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Side A->B with apex C, its twin B->A with apex D: the edge becomes D-C.
    void flip(uint32_t side, uint32_t twin) {
        const double base = graph_.side_length[side];
        const uint32_t to_c = TriangleGraph::next(side), from_c = TriangleGraph::previous(side);
        const uint32_t to_d = TriangleGraph::next(twin), from_d = TriangleGraph::previous(twin);
        const PlanePoint c = apex_over(base, graph_.side_length[from_c], graph_.side_length[to_c]);
        const PlanePoint d = apex_over(base, graph_.side_length[to_d], graph_.side_length[from_d]);
        const double diagonal = std::hypot(c.x - d.x, c.y + d.y);
        turn_origin(side, to_d, -std::atan2(d.y, d.x));
        turn_origin(twin, to_c, -std::atan2(c.y, base - c.x));
        mark_flipped(side);
        mark_flipped(twin);

        const uint32_t one = side - side % 3, two = twin - twin % 3;
        const std::array<uint32_t, 4> old_slots = {from_c, to_d, from_d, to_c};
        const std::array<uint32_t, 4> new_slots = {one + 1, one + 2, two + 1, two + 2};
        move_sides(old_slots, new_slots);
        graph_.corner_vertex[one] = graph_.corner_vertex[two + 1]; // D
        graph_.corner_vertex[two] = graph_.corner_vertex[one + 1]; // C
        graph_.side_length[one] = graph_.side_length[two] = diagonal;
        side_before_[one] = side_before_[two] = no_index;
        graph_.across[one] = 2 * two;
        graph_.across[two] = 2 * one;
        candidates_.insert(candidates_.end(), new_slots.begin(), new_slots.end());
    }

    void mark_flipped(uint32_t side) {
        const uint32_t before = side_before_[side];
        if (before != no_index) {
            flipped_[before / 3] |= static_cast<uint8_t>(1U << before % 3);
        }
    }

    /// The flip takes `side` away: its vertex counts from the side next clockwise instead.
    void turn_origin(uint32_t side, uint32_t clockwise, double angle) {
        DirectionOrigin& origin = origins_[graph_.from(side)];
        if (origin.side == side) {
            origin = {clockwise, static_cast<float>(origin.direction + angle)};
        }
    }

    void move_sides(const std::array<uint32_t, 4>& from, const std::array<uint32_t, 4>& to) {
        struct Moved {
            uint32_t vertex, across, before, side_before;
            double length;
        };
        std::array<Moved, 4> moved;
        for (size_t i = 0; i < 4; ++i) {
            moved[i] = {graph_.from(from[i]), graph_.across[from[i]], no_index, side_before_[from[i]],
                        graph_.side_length[from[i]]};
            for (uint32_t link = moved[i].across; link != no_index; link = graph_.across[link >> 1]) {
                if (graph_.across[link >> 1] >> 1 == from[i]) {
                    moved[i].before = link >> 1;
                    break;
                }
            }
        }
        for (size_t i = 0; i < 4; ++i) {
            graph_.corner_vertex[to[i]] = moved[i].vertex;
            graph_.side_length[to[i]] = moved[i].length;
            graph_.across[to[i]] = moved[i].across;
            side_before_[to[i]] = moved[i].side_before;
        }
        for (size_t i = 0; i < 4; ++i) {
            if (moved[i].before != no_index) {
                graph_.across[moved[i].before] = 2 * to[i] + (graph_.across[moved[i].before] & 1);
            }
            // The four corners are different vertices, so no origin is moved twice.
            DirectionOrigin& origin = origins_[moved[i].vertex];
            origin.side = origin.side == from[i] ? to[i] : origin.side;
        }
    }

    IntrinsicGraph& graph_;
    std::vector<DirectionOrigin> origins_;
    std::vector<uint32_t> side_before_; ///< per side: what it was before all flips; no_index: made by one
    std::vector<uint8_t> flipped_;
    std::vector<uint32_t> candidates_;
};

} // namespace

IntrinsicGraph by_lengths(const TriangleGraph& graph) {
    IntrinsicGraph result{static_cast<const TriangleLinks&>(graph), {}};
    fill_large(result.side_length, graph.corner_vertex.size());
    parallel_for(graph.corner_vertex.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t side = begin; side < end; ++side) {
            result.side_length[side] = graph.length(static_cast<uint32_t>(side));
        }
    });
    return result;
}

IntrinsicDelaunay flip_to_delaunay(IntrinsicGraph& graph) {
    return Flipper(graph).run();
}

} // namespace anvil
