// Fast marching with a virtual source (Novotni & Klein 2002), label-correcting.
#pragma once

#include "engine/distance/source_seeds.h"
#include "engine/distance/triangle_graph.h"

#include <utility>
#include <vector>

namespace anvil {

/// Distance of the third corner from one source seen through an edge: `near_start`, `near_end` are the known
/// distances of the edge's ends, `edge` its length, `left` and `right` the sides from the ends to the corner.
/// Where the ray from the virtual source misses the edge, or no such source exists, the way along a side.
double virtual_source_update(double near_start, double near_end, double edge, double left, double right);

/// A workspace over one graph, kept between runs; a run touches only what it reaches.
class VirtualSourceMarching {
  public:
    explicit VirtualSourceMarching(const TriangleGraph& graph);

    /// Marches from the seeds until every vertex within `radius` (units of the graph) is final.
    void run(std::span<const Seed> seeds, double radius);

    /// Vertices that have a value, in order of arrival; values beyond the radius need not be final.
    std::span<const uint32_t> reached() const { return reached_; }
    double distance(uint32_t vertex) const { return records_[vertex].distance; }

  private:
    struct Record {
        double distance = infinity;
        uint32_t label = 0;
        uint32_t run = 0;  ///< the run that this record belongs to
        uint16_t pops = 0; ///< how often it was taken from the front in this run
        bool waiting = false;
    };

    void offer(uint32_t vertex, double distance, uint32_t label);
    void march_from(uint32_t vertex);
    void update(uint32_t from, uint32_t side_end, uint32_t corner, double edge, double left, double right);
    const Record* reached_record(uint32_t vertex) const {
        return records_[vertex].run == run_ ? &records_[vertex] : nullptr;
    }

    const TriangleGraph& graph_;
    std::vector<Record> records_;
    std::vector<std::pair<double, uint32_t>> heap_;
    std::vector<uint32_t> reached_;
    uint32_t run_ = 0;
};

} // namespace anvil
