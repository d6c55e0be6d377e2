// The yardstick of distances: shortest paths along edges, as lean as they get.
#pragma once

#include "engine/distance/triangle_graph.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace anvil {

/// Edges in one array with stored lengths, stamped values, a binary heap that keeps its memory: no allocation
/// and no work over the whole mesh in a run.
class LeanDijkstra {
  public:
    explicit LeanDijkstra(const TriangleGraph& graph) : values_(graph.vertex_count()) {
        std::vector<std::pair<uint32_t, double>> around;
        begin_.push_back(0);
        for (uint32_t v = 0; v < graph.vertex_count(); ++v) {
            around.clear();
            for (const uint32_t side : graph.sides_leaving(v)) {
                const uint32_t arriving = TriangleGraph::previous(side);
                around.emplace_back(graph.to(side), graph.length(side));
                around.emplace_back(graph.from(arriving), graph.length(arriving));
            }
            std::sort(around.begin(), around.end());
            around.erase(std::unique(around.begin(), around.end(),
                                     [](const auto& a, const auto& b) { return a.first == b.first; }),
                         around.end());
            for (const auto& [vertex, length] : around) {
                to_.push_back(vertex);
                length_.push_back(length);
            }
            begin_.push_back(static_cast<uint32_t>(to_.size()));
        }
    }

    /// @return how many vertices lie within the radius (units of the graph).
    size_t run(uint32_t source, double radius) {
        ++run_;
        heap_.clear();
        values_[source] = {0, run_};
        heap_.emplace_back(0, source);
        size_t settled = 0;
        while (!heap_.empty()) {
            std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
            const auto [distance, vertex] = heap_.back();
            heap_.pop_back();
            if (distance > values_[vertex].distance) {
                continue;
            }
            if (distance > radius) {
                break;
            }
            ++settled;
            for (uint32_t i = begin_[vertex]; i < begin_[vertex + 1]; ++i) {
                const double through = distance + length_[i];
                Value& value = values_[to_[i]];
                if (value.run != run_ || through < value.distance) {
                    value = {through, run_};
                    heap_.emplace_back(through, to_[i]);
                    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
                }
            }
        }
        return settled;
    }

  private:
    struct Value {
        double distance = 0;
        uint32_t run = 0;
    };
    std::vector<uint32_t> begin_, to_;
    std::vector<double> length_;
    std::vector<Value> values_;
    std::vector<std::pair<double, uint32_t>> heap_;
    uint32_t run_ = 0;
};

} // namespace anvil
