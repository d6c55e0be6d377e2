// What of a mesh may be nearest to many points, found by other means than the processor's: a device's.
#pragma once

#include "engine/mesh/search_tree.h"

#include <array>
#include <memory>
#include <span>

namespace anvil {

/// Slots of a search tree that hold all that may be nearest to a point; NO_TRIANGLE where there are fewer, in
/// all of them where the search does not know.
using NearSlots = std::array<uint32_t, kernel::f32::MOST_NEAR>;

/// One tree, put where it is searched. Calls from one thread at a time.
class TriangleSearch {
  public:
    virtual ~TriangleSearch() = default;

    /// Points are the tree's local() ones; found[i] for points[i]. @return false: it cannot go on, nor later.
    /// @throws DeviceError
    virtual bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) = 0;
};

/// Where trees can be put. Calls from one thread at a time.
class SearchDevice {
  public:
    virtual ~SearchDevice() = default;

    /// nullptr: not there. The search must not outlive this; it keeps nothing of the tree that is given.
    /// @throws DeviceError
    virtual std::unique_ptr<TriangleSearch> put(const NarrowTree& tree) = 0;
};

} // namespace anvil
