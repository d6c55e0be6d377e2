#include "engine/distance/virtual_source_marching.h"

#include "engine/distance/unfold.h"

#include <functional>

namespace anvil {
namespace {

// Obtuse triangles can make vertices lower each other in a cycle that contracts slowly: a vertex that was
// already taken from the front returns only for a noticeable gain, and not for ever.
constexpr double noticeable = 1e-6;
constexpr uint16_t most_pops = 32;

// Below this ratio of edge to distance the virtual source has no digits left; the error of going along a side
// instead is at most the edge.
constexpr double shortest_base = 1e-8;

} // namespace

double virtual_source_update(double near_start, double near_end, double edge, double left, double right) {
    const double bent = std::min(near_start + left, near_end + right);
    if (std::abs(near_start - near_end) > edge || edge <= shortest_base * (near_start + near_end)) {
        return bent;
    }
    const PlanePoint source = apex_over(edge, near_start, near_end);
    const PlanePoint corner = apex_over(edge, left, right);
    // Strictly: a ray through an end is the way along a side, and four points on one line have no crossing.
    const bool right_of_start = source.x * corner.y + corner.x * source.y > 0;
    const bool left_of_end = (edge - source.x) * corner.y + (edge - corner.x) * source.y > 0;
    if (!right_of_start || !left_of_end) {
        return bent;
    }
    return std::min(bent, std::hypot(corner.x - source.x, corner.y + source.y));
}

VirtualSourceMarching::VirtualSourceMarching(const TriangleGraph& graph)
    : graph_(graph), records_(graph.vertex_count()) {}

void VirtualSourceMarching::offer(uint32_t vertex, double distance, uint32_t label) {
    Record& record = records_[vertex];
    if (record.run != run_) {
        record = {infinity, label, run_, 0, false};
        reached_.push_back(vertex);
    }
    if (!(distance < record.distance)) {
        return;
    }
    const bool worth_a_return = distance < record.distance * (1 - noticeable) && record.pops < most_pops;
    record.distance = distance;
    record.label = label;
    if (record.pops == 0 || record.waiting || worth_a_return) {
        record.waiting = true;
        heap_.emplace_back(distance, vertex);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
}

void VirtualSourceMarching::update(uint32_t from, uint32_t side_end, uint32_t corner, double edge,
                                   double left, double right) {
    const Record& a = records_[from];
    const Record* b = reached_record(side_end);
    const bool one_source = b != nullptr && b->label == a.label;
    const double distance =
        one_source ? virtual_source_update(a.distance, b->distance, edge, left, right) : a.distance + left;
    offer(corner, distance, a.label);
}

void VirtualSourceMarching::march_from(uint32_t vertex) {
    for (const uint32_t side : graph_.sides_leaving(vertex)) {
        const uint32_t second = graph_.corner_vertex[TriangleGraph::next(side)];
        const uint32_t third = graph_.corner_vertex[TriangleGraph::previous(side)];
        const double out = graph_.side_length[side];
        const double across = graph_.side_length[TriangleGraph::next(side)];
        const double back = graph_.side_length[TriangleGraph::previous(side)];
        update(vertex, second, third, out, back, across);
        update(vertex, third, second, back, out, across);
    }
}

void VirtualSourceMarching::run(std::span<const Seed> seeds, double radius) {
    if (++run_ == 0) {
        std::fill(records_.begin(), records_.end(), Record{});
        run_ = 1;
    }
    reached_.clear();
    heap_.clear();
    for (const Seed& seed : seeds) {
        offer(seed.vertex, seed.distance, seed.label);
    }
    // A vertex may be lowered by one that is farther, through an obtuse corner, but by no more than a side.
    const double last = radius + graph_.longest_side;
    while (!heap_.empty() && heap_.front().first <= last) {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        const auto [distance, vertex] = heap_.back();
        heap_.pop_back();
        Record& record = records_[vertex];
        if (distance == record.distance && record.waiting) {
            record.waiting = false;
            ++record.pops;
            march_from(vertex);
        }
    }
}

} // namespace anvil
