#include "engine/occluder/mesh_distance.h"

#include "engine/core/error.h"
#include "engine/mesh/search_tree.h"
#include "engine/occluder/winding_number.h"

#include <cmath>

namespace anvil {

namespace {

class MeshDistance final : public ExactDistance {
  public:
    explicit MeshDistance(const Mesh& mesh)
        : triangles_(mesh.triangles), positions_(mesh.positions), tree_(mesh.positions, mesh.triangles),
          winding_(mesh.positions, mesh.triangles) {
        for (const Triangle& t : triangles_) {
            for (uint32_t v : t) {
                bounds_.include(positions_[v]);
            }
        }
    }

    SignedDistance at(const Vec3& p) const override {
        const ClosestPoint closest = tree_.closest(p);
        const double sign = inside(p) ? -1 : 1;
        const Vec3 arm = p - closest.position;
        if (closest.distance > 1e-9 * bounds_.diagonal()) {
            return {sign * closest.distance, sign / closest.distance * arm};
        }
        return {sign * closest.distance, outward_normal(closest)};
    }

    Box bounds() const override { return bounds_; }

  private:
    bool inside(const Vec3& p) const {
        const bool beyond =
            glm::any(glm::lessThan(p, bounds_.low)) || glm::any(glm::greaterThan(p, bounds_.high));
        return !beyond && std::abs(winding_.at(p)) > 0.5;
    }

    /// The face's normal, on the side that is not inside.
    Vec3 outward_normal(const ClosestPoint& closest) const {
        const Triangle& t = triangles_[closest.triangle];
        const Vec3 area =
            glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
        const double size = glm::length(area);
        const Vec3 normal = size > 0 ? area / size : Vec3(0, 1, 0);
        const double step = 1e-4 * bounds_.diagonal();
        return inside(closest.position + step * normal) && !inside(closest.position - step * normal) ? -normal
                                                                                                     : normal;
    }

    std::vector<Triangle> triangles_;
    std::vector<Vec3> positions_;
    SearchTree tree_;
    WindingNumber winding_;
    Box bounds_;
};

} // namespace

std::shared_ptr<const ExactDistance> mesh_distance(const Mesh& mesh) {
    if (mesh.triangles.empty()) {
        throw InputError("the mesh has no triangle, so there is no solid to be an occluder");
    }
    return std::make_shared<MeshDistance>(mesh);
}

} // namespace anvil
