// Approximate geodesic distances: a front at every vertex, blended across edges.
#pragma once

#include "engine/distance/bucket_queue.h"
#include "engine/distance/fan_table.h"
#include "engine/distance/front_blend.h"

namespace anvil {

/// Start value of a front: `vertex` sees source `label` in a straight line.
struct FrontSeed {
    uint32_t vertex = 0;
    uint32_t label = 0;
    float distance = 0;
    float direction = 0; ///< to the source, at the vertex
    float offset = 0;    ///< of the centre; below 0 for the flat front of a line
};

/// A workspace over one table, kept between runs; a run touches only what it reaches.
/// Every vertex that is reached carries its distance d, an offset s and the direction of a centre at d - s:
/// near the vertex the distance is s + the way to the centre, so bends (s: distance of the bend) are kept.
/// The third corner of a triangle gets a Hermite blend of the fronts of both ends of the opposite edge:
/// second order on smooth surfaces, exact where the surface unfolds.
class VertexFronts {
  public:
    explicit VertexFronts(const FanTable& table);

    /// Forgets the last run.
    void clear();

    /// More sources: what they improve is done again by the next grow(), and nothing else.
    void add(std::span<const FrontSeed> seeds);

    /// Marches on until every vertex within `radius` (units of the graph, not less than before) has the value
    /// of an unbounded run, bit for bit.
    void grow(double radius);

    /// Vertices that have a value, in order of arrival; values beyond the radius need not be final.
    std::span<const uint32_t> reached() const { return reached_; }
    float distance(uint32_t vertex) const { return fronts_[vertex].distance; }
    /// How often a vertex has been marched from.
    size_t marched() const { return marched_; }

  private:
    struct Waiting {
        float distance;
        uint32_t vertex;
    };
    struct Opposite;

    bool is_reached(const Front& front) const { return front.stamp >= run_stamp_; }
    static bool is_settled(const Front& front) { return (front.stamp & 1) != 0; }
    void accept(uint32_t vertex, float distance, float offset, float direction, uint32_t label,
                uint32_t parents, float delay = 0);
    void fetch_spokes(const Front& front) const;
    void fetch_around_next() const;
    void march_from(uint32_t vertex);
    void update(uint32_t from, const Opposite& o);
    bool may_lower(const Front& a, const Front& corner, float length, float x, float y) const;
    void follow_edge(uint32_t from, const Spoke& spoke);
    void repair_around(uint32_t vertex);
    void find_again(uint32_t vertex);

    const FanTable& table_;
    std::vector<Front> fronts_;
    BucketQueue<Waiting> queue_;
    std::vector<uint32_t> reached_;
    uint32_t run_stamp_ = 0;
    size_t marched_ = 0;
    float least_ = -1; ///< values below this come too late: the front has passed
    float slack_ = 0;
};

} // namespace anvil
