// Where the fronts of an edge's ends disagree: ways through the triangles behind it.
#pragma once

#include "engine/distance/fan_table.h"
#include "engine/distance/front_blend.h"

#include <span>

namespace anvil {

/// Part of its own distance that two fronts may differ by and still be blended as one. Half of it changes
/// the mean error by a seventh, and makes regions of 2000 vertices a quarter slower.
inline constexpr float fronts_agree = 0.007F;

/// Where fronts disagree there is more between them than either knows: a vertex that bends paths, another
/// front. A point then looks through the edge at those behind it, each seen in part, until the fronts of
/// their ends agree: the way of a window, taken back for a few triangles where it matters.
class LookBehind {
  public:
    /// @param known: fronts with at least this stamp have a value, which is final if bit `settled` is set.
    LookBehind(const FanTable& table, std::span<const Front> fronts, uint32_t known, uint32_t settled)
        : table_(table), fronts_(fronts), known_(known), settled_(settled) {}

    /// The best way to a point above the edge from `left` to `right`, the centre in the frame of `sight` but
    /// y < 0 below the edge. Never if what lies behind is unknown: the edge itself then has to do.
    FrontArrival best_way(uint32_t left, uint32_t right, const EdgeSight& sight) const;

  private:
    struct Edge;
    struct Wedge;
    bool is_known(uint32_t vertex) const {
        return fronts_[vertex].stamp >= known_ && (fronts_[vertex].stamp & settled_) != 0;
    }
    uint32_t spoke_to(uint32_t vertex, uint32_t other, float direction) const;
    uint32_t next_spoke(uint32_t vertex, uint32_t spoke) const {
        return spoke + 1 < fronts_[vertex + 1].first_spoke ? spoke + 1 : fronts_[vertex].first_spoke;
    }
    void through(const Edge& edge, const Wedge& wedge, int levels, FrontArrival& best) const;
    void behind(const Edge& edge, const Wedge& wedge, int levels, FrontArrival& best) const;
    void bend_at(uint32_t vertex, float towards_right, const FrontPoint& at, const FrontPoint& right,
                 const FrontPoint& eye, FrontArrival& best) const;

    const FanTable& table_;
    std::span<const Front> fronts_;
    uint32_t known_, settled_;
};

/// Whether a path that bends at the vertex is the shortest near it: at least half a turn on both sides, or
/// the boundary in place of one.
bool is_in_shadow(const Front& front, float direction);

} // namespace anvil
