// The nearest points of a triangle mesh for many queries at once.
#pragma once

#include "engine/mesh/search_tree.h"

#include <memory>
#include <span>

namespace anvil {

class ClosestPointSearch;

/// Answers the queries of one thread, at a fraction of the price of SearchTree::closest() where they lie as
/// close together as the samples of a field: eight are searched for at once.
class ClosestPointTracer {
  public:
    /// `tree` outlives the tracer.
    explicit ClosestPointTracer(const SearchTree& tree);
    ~ClosestPointTracer();
    ClosestPointTracer(const ClosestPointTracer&) = delete;
    ClosestPointTracer& operator=(const ClosestPointTracer&) = delete;

    /// The nearest points in any order, found[i] for queries[i]. Of equally near triangles it may be another
    /// one than SearchTree::closest() finds. Nothing is found for what is not finite.
    void closest(std::span<const Vec3> queries, std::span<ClosestPoint> found);

  private:
    std::unique_ptr<ClosestPointSearch> search_;
};

} // namespace anvil
