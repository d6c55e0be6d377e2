#include "engine/occluder/exact_distance.h"

#include <algorithm>

namespace anvil {

namespace {

class PointByPoint final : public DistanceTracer {
  public:
    explicit PointByPoint(const ExactDistance& solid) : solid_(solid) {}

    void trace(std::span<const Vec3> points, std::span<SignedDistance> found) override {
        std::transform(points.begin(), points.end(), found.begin(),
                       [this](const Vec3& p) { return solid_.at(p); });
    }

  private:
    const ExactDistance& solid_;
};

} // namespace

std::unique_ptr<DistanceTracer> ExactDistance::tracer() const {
    return std::make_unique<PointByPoint>(*this);
}

} // namespace anvil
