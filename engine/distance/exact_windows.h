// Exact geodesic distances: windows of straight rays, after Chen & Han 1990 and Xin & Wang 2009.
#pragma once

#include "engine/distance/bucket_queue.h"
#include "engine/distance/segment_seeds.h"
#include "engine/distance/window_rays.h"
#include "engine/distance/window_table.h"

#include <unordered_map>

namespace anvil {

/// A workspace over one surface, kept between runs; a run touches only what it reaches.
/// A window is the part of an edge that straight rays from one source (a point, a line, or one bend) enter a
/// triangle through. Windows cross triangles, split at the opposite corner, and are dropped where known
/// vertex distances prove that none of their rays is shortest; rays start anew where paths can bend.
/// Distances are exact for the polyhedral surface up to rounding.
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
    double distance(uint32_t vertex) const { return distance_[vertex]; }
    size_t windows() const { return windows_; }

  private:
    enum class Kind : uint32_t { point, parallel, bend };
    struct Window {
        std::array<double, 2> rim{}; ///< first and last ray, along the side
        PlanePoint source;           ///< with `offset`: the rays, by kind
        double offset = 0;
        uint32_t place = no_index; ///< the side entered through, its frame; a bend: the vertex
        Kind kind = Kind::point;
    };
    struct Arrival {
        double angle = 0;         ///< from `side` counterclockwise to the ray back
        uint32_t side = no_index; ///< leaves the vertex; none: the vertex is a source
    };
    struct Best {
        double distance = 0, crossing = 0;
        uint32_t run = 0;
    };
    /// Rays up to `left_end` leave on the left, those from `right_begin` on the right.
    struct Split {
        double left_end, right_begin;
    };
    /// A side that rays leave a triangle through, in the frame from its near end.
    struct Exit {
        uint32_t side, across; ///< as in WindowTable::Face
        uint32_t near_vertex, far_vertex;
        double length;
        bool turned; ///< the frame runs against the side
    };

    void arrive(uint32_t vertex, double distance, uint32_t side, double angle);
    bool cross_beside(const Window& window);
    template <typename Rays>
    void cross(const Window& window);
    Split split(const Window& window, double crossing, double distance);
    template <typename Rays>
    void leave(const Rays& rays, double first, double last, bool to_corner, double base,
               const PlanePoint& along, double over_corner, const Exit& exit);
    template <typename Rays>
    void pass(const Rays& rays, double begin, double end, const Exit& exit);
    bool came_before(const Window& window);
    Exit exit_of(uint32_t side) const;

    void bend_at(uint32_t vertex);
    void follow_edges(uint32_t vertex);
    void emit(uint32_t side, double first, double last, double offset);
    void emit_shadow(uint32_t vertex);
    void start_in_triangle(const Seed& seed);
    void start_line(const Segment& line);

    const TriangleGraph& graph_;
    const WindowTable& table_;
    std::vector<double> distance_; ///< per vertex, infinite where not reached
    std::vector<Arrival> arrival_;
    std::vector<Best> best_; ///< per side: the best window that covers the opposite corner
    std::unordered_map<uint32_t, std::vector<Window>> into_thin_; ///< by side, of thin faces
    BucketQueue<Window> queue_;
    std::vector<uint32_t> reached_;
    uint32_t run_ = 0;
    size_t windows_ = 0;
};

} // namespace anvil
