#include "engine/core/error.h"
#include "engine/mesh/polygonize.h"
#include "engine/mesh/search_tree.h"
#include "engine/occluder/exact_distance.h"

#include <cmath>

namespace anvil {

namespace {

class Redistanced final : public ExactDistance {
  public:
    Redistanced(std::shared_ptr<const ExactDistance> solid, const Mesh& surface)
        : solid_(std::move(solid)), tree_(surface.positions, surface.triangles), bounds_(solid_->bounds()) {}

    SignedDistance at(const Vec3& p) const override {
        const SignedDistance bound = solid_->at(p);
        const Vec3 foot = on_surface(tree_.closest(p).position);
        const double distance = std::max(glm::length(p - foot), std::abs(bound.distance));
        if (distance <= 1e-9 * bounds_.diagonal()) {
            return bound;
        }
        const double sign = bound.distance < 0 ? -1 : 1;
        const Vec3 arm = p - foot;
        const double length = glm::length(arm);
        return {sign * distance, length > 0 ? sign / length * arm : bound.normal};
    }

    Box bounds() const override { return bounds_; }

  private:
    /// Puts a point of the polygonization on the zero set of the formula.
    Vec3 on_surface(Vec3 q) const {
        for (int i = 0; i < 2; ++i) {
            const SignedDistance s = solid_->at(q);
            q -= s.distance * s.normal;
        }
        return q;
    }

    std::shared_ptr<const ExactDistance> solid_;
    SearchTree tree_;
    Box bounds_;
};

} // namespace

Mesh surface_of(const ExactDistance& solid, int cells) {
    const Box box = solid.bounds();
    if (box.empty() || !(box.diagonal() > 0)) {
        return {};
    }
    PolygonizeOptions options;
    options.cells = cells;
    options.sharp = true;
    options.lipschitz = true;
    return polygonize([&](const Vec3& p) { return solid.at(p).distance; }, box, options);
}

std::shared_ptr<const ExactDistance> redistanced(std::shared_ptr<const ExactDistance> solid, int cells) {
    const Box box = solid->bounds();
    if (!box.empty() && !(is_finite(box.low) && is_finite(box.high))) {
        throw InputError("the solid is unbounded: intersect it with a bounded shape to bake it");
    }
    const Mesh surface = surface_of(*solid, cells);
    if (surface.triangles.empty()) {
        throw InputError(
            "the solid is empty: its parts leave nothing over; move them so that something remains");
    }
    return std::make_shared<Redistanced>(std::move(solid), surface);
}

} // namespace anvil
