#include "engine/mesh/lasting_search.h"

#include "engine/core/error.h"

namespace anvil {

class LastingSearchDevice::Search final : public TriangleSearch {
  public:
    Search(LastingSearchDevice& device, std::unique_ptr<TriangleSearch> search)
        : device_(device), search_(std::move(search)) {}

    bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) override {
        return device_.unless_failed([&] { return search_->find(points, found); });
    }

  private:
    LastingSearchDevice& device_;
    std::unique_ptr<TriangleSearch> search_;
};

/// What the work returns, or nothing (false, nullptr) once the device has failed.
template <class Work>
auto LastingSearchDevice::unless_failed(const Work& work) -> decltype(work()) {
    if (!failed_) {
        try {
            return work();
        } catch (const DeviceError& error) {
            failed_ = true;
            log_.warn(std::string(error.what()) + "; distance fields are baked on the CPU");
        }
    }
    return {};
}

std::unique_ptr<TriangleSearch> LastingSearchDevice::put(const NarrowTree& tree) {
    return unless_failed([&]() -> std::unique_ptr<TriangleSearch> {
        std::unique_ptr<TriangleSearch> search = device_.put(tree);
        return search ? std::make_unique<Search>(*this, std::move(search)) : nullptr;
    });
}

} // namespace anvil
