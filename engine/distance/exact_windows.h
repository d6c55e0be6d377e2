// Exact geodesic distances: windows of straight rays, after Chen & Han 1990 and Xin & Wang 2009.
#pragma once

#include "engine/distance/bucket_queue.h"
#include "engine/distance/segment_seeds.h"
#include "engine/distance/window_table.h"

namespace anvil {

/// A workspace over one surface, kept between runs; a run touches only what it reaches.
/// A window is the part of an edge that straight rays from one source (or one bend) enter a triangle through.
/// Windows cross triangles, split at the opposite corner, and are dropped where known vertex distances prove
/// that none of their rays is shortest; rays start anew where paths can bend. Distances are exact for the
/// polyhedral surface up to rounding.
class ExactWindows {
  public:
    ExactWindows(const TriangleGraph& graph, const WindowTable& table);

    /// Forgets the last run.
    void clear();

    /// More sources: what they improve is done again by the next grow(), and nothing else.
    void add(const SourceParts& sources);

    /// Propagates until every vertex within `radius` (units of the graph, not less than before) is final;
    /// those values are bit for bit the ones of an unbounded run.
    /// @return false if the windows became too many (2000 a vertex); the values are then of no use.
    bool grow(double radius);

    /// Vertices that have a value, in order of arrival; values beyond the radius need not be final.
    std::span<const uint32_t> reached() const { return reached_; }
    double distance(uint32_t vertex) const { return vertices_[vertex].distance; }
    size_t windows() const { return windows_; }

  private:
    struct Window {
        uint32_t side = no_index; ///< entered through it, its frame; no_index: paths bend at `vertex`
        uint32_t vertex = no_index;
        double begin = 0, end = 0;
        PlanePoint source; ///< y >= 0: below the side
        double offset = 0; ///< distance of the source itself
        double at_begin = 0, at_end = 0;
    };
    struct Arrival {
        double distance = 0;
        double angle = 0;         ///< from `side` counterclockwise to the ray back
        uint32_t side = no_index; ///< leaves the vertex; none: the vertex is a source
        uint32_t run = 0;
    };
    struct Best {
        double distance = 0, crossing = 0;
        uint32_t run = 0;
    };
    struct Child;

    double known(uint32_t vertex) const {
        return vertices_[vertex].run == run_ ? vertices_[vertex].distance : infinity;
    }
    bool is_dominated(uint32_t from, uint32_t to, double length, const Window& window) const;
    void arrive(uint32_t vertex, double distance, uint32_t side, double angle);
    void start_in_triangle(const Seed& seed);
    void start_line(const Segment& line);
    void push(const Window& window, double key);
    void enter(const Child& child);
    void cross(const Window& window);
    void bend_at(uint32_t vertex);
    void follow_edges(uint32_t vertex);
    void emit(uint32_t side, double first, double last, double offset);
    void emit_shadow(uint32_t vertex);

    const TriangleGraph& graph_;
    const WindowTable& table_;
    std::vector<Arrival> vertices_;
    std::vector<Best> best_; ///< per side: the best window that covers the opposite corner
    BucketQueue<Window> queue_;
    std::vector<uint32_t> reached_;
    uint32_t run_ = 0;
    size_t windows_ = 0;
};

} // namespace anvil
