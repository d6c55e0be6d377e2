// Searching on a device that may fail.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/triangle_search.h"

namespace anvil {

/// A device whose errors (lost, out of memory) become one warning, and an answer that tells the caller to go
/// on without it.
class LastingSearchDevice final : public SearchDevice {
  public:
    /// Both outlive it.
    LastingSearchDevice(SearchDevice& device, Log& log) : device_(device), log_(log) {}

    std::unique_ptr<TriangleSearch> put(const NarrowTree& tree) override;

  private:
    class Search;
    template <class Work>
    auto unless_failed(const Work& work) -> decltype(work());

    SearchDevice& device_;
    Log& log_;
    bool failed_ = false;
};

} // namespace anvil
