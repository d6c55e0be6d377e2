// A device that searches as a kernel does, for a while.
#pragma once

#include "engine/core/error.h"
#include "tests/support/narrow_search.h"

namespace anvil {

class FailingSearchDevice final : public SearchDevice {
  public:
    /// Throws DeviceError from then on.
    explicit FailingSearchDevice(int calls) : left_(calls) {}

    std::unique_ptr<TriangleSearch> put(const NarrowTree& tree) override {
        count();
        return std::make_unique<Search>(*this, tree);
    }

    size_t searched() const { return searched_; } ///< points

  private:
    class Search final : public TriangleSearch {
      public:
        Search(FailingSearchDevice& device, const NarrowTree& tree)
            : device_(device), tree_(tree), search_(tree_) {}

        bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) override {
            device_.count();
            device_.searched_ += points.size();
            return search_.find(points, found);
        }

      private:
        FailingSearchDevice& device_;
        NarrowTree tree_;
        NarrowSearch search_;
    };

    void count() {
        if (left_ == 0) {
            throw DeviceError("the device was lost");
        }
        --left_;
    }

    int left_;
    size_t searched_ = 0;
};

} // namespace anvil
