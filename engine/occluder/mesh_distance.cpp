#include "engine/occluder/mesh_distance.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/closest_points.h"
#include "engine/mesh/triangle_search.h"
#include "engine/occluder/face_orientation.h"
#include "engine/occluder/solid_warnings.h"
#include "engine/occluder/surface_sides.h"
#include "engine/occluder/winding_number.h"

#include <cmath>

namespace anvil {

namespace {

class MeshDistance final : public ExactDistance {
  public:
    MeshDistance(std::span<const Vec3> positions, std::vector<Triangle> triangles)
        : triangles_(std::move(triangles)), positions_(positions.begin(), positions.end()),
          tree_(positions_, triangles_), winding_(positions_, triangles_),
          sides_(positions_, triangles_, tree_, winding_) {
        for (const Triangle& t : triangles_) {
            for (uint32_t v : t) {
                bounds_.include(positions_[v]);
            }
        }
    }

    SignedDistance at(const Vec3& p) const override { return signed_distance(p, tree_.closest(p)); }

    std::unique_ptr<DistanceTracer> tracer() const override { return std::make_unique<Tracer>(*this); }

    std::unique_ptr<DistanceTracer> tracer_with(SearchDevice& device) const override;

    Box bounds() const override { return bounds_; }

    size_t crossing_triangles() const { return sides_.crossing_triangles(); }
    /// Whether faces may be flipped or there twice.
    bool tangled() const { return sides_.tangled(); }

  private:
    class Tracer final : public DistanceTracer {
      public:
        explicit Tracer(const MeshDistance& solid) : solid_(solid), nearest_(solid.tree_) {}

        void enter(const Box& box) override { nearest_.enter(box); }

        void trace(std::span<const Vec3> points, std::span<SignedDistance> found) override {
            closest_.resize(points.size());
            nearest_.closest(points, closest_);
            for (const ClosestPoint& closest : closest_) {
                solid_.sides_.prefetch(closest);
            }
            for (size_t i = 0; i < points.size(); ++i) {
                found[i] = solid_.signed_distance(points[i], closest_[i]);
            }
        }

      private:
        const MeshDistance& solid_;
        ClosestPointTracer nearest_;
        std::vector<ClosestPoint> closest_;
    };

    class DeviceTracer;

    SignedDistance signed_distance(const Vec3& p, const ClosestPoint& closest) const {
        const Vec3 arm = p - closest.position;
        if (closest.distance > 1e-9 * bounds_.diagonal()) {
            const double sign = inside(p, closest) ? -1 : 1;
            return {sign * closest.distance, sign / closest.distance * arm};
        }
        return {inside(p) ? -closest.distance : closest.distance, outward_normal(closest)};
    }

    bool beyond_bounds(const Vec3& p) const {
        return glm::any(glm::lessThan(p, bounds_.low)) || glm::any(glm::greaterThan(p, bounds_.high));
    }

    bool inside(const Vec3& p) const { return !beyond_bounds(p) && std::abs(winding_.at(p)) > 0.5; }

    bool inside(const Vec3& p, const ClosestPoint& closest) const {
        if (beyond_bounds(p)) {
            return false;
        }
        const std::optional<int> told = sides_.winding(p, closest);
        return told ? *told != 0 : std::abs(winding_.at(p)) > 0.5;
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
    SurfaceSides sides_;
    Box bounds_;
};

/// The device finds the few triangles that may be nearest; those are decided between here, in double, so that
/// the result is the same as without it. Once it has failed, all is done here.
class MeshDistance::DeviceTracer final : public DistanceTracer {
  public:
    DeviceTracer(const MeshDistance& solid, const NarrowTree& tree, std::unique_ptr<TriangleSearch> search)
        : solid_(solid), place_(tree), search_(std::move(search)) {}

    void trace(std::span<const Vec3> points, std::span<SignedDistance> found) override {
        if (!search_ || !search(points)) {
            search_.reset();
        }
        parallel_for(points.size(), at_once, [&](size_t begin, size_t end) {
            const auto part = points.subspan(begin, end - begin);
            if (search_) {
                decide(part, std::span(near_).subspan(begin), found.subspan(begin));
            } else {
                Tracer(solid_).trace(part, found.subspan(begin, part.size()));
            }
        });
    }

  private:
    static constexpr size_t at_once = 512;

    bool search(std::span<const Vec3> points) {
        local_.resize(points.size());
        near_.resize(points.size());
        parallel_for(points.size(), at_once, [&](size_t begin, size_t end) {
            std::transform(&points[begin], &points[begin] + (end - begin), &local_[begin],
                           [this](const Vec3& p) { return place_.local(p); });
        });
        return search_->find(local_, near_);
    }

    void decide(std::span<const Vec3> points, std::span<const NearSlots> near,
                std::span<SignedDistance> found) const {
        for (size_t i = 0; i < points.size(); ++i) {
            const auto end = std::find(near[i].begin(), near[i].end(), kernel::f32::NO_TRIANGLE);
            const std::span<const uint32_t> slots(near[i].begin(), end);
            const SearchTree& tree = solid_.tree_;
            found[i] = solid_.signed_distance(points[i], slots.empty() ? tree.closest(points[i])
                                                                       : tree.closest_of(points[i], slots));
        }
    }

    const MeshDistance& solid_;
    NarrowPlace place_;
    std::unique_ptr<TriangleSearch> search_;
    std::vector<glm::vec3> local_;
    std::vector<NearSlots> near_;
};

std::unique_ptr<DistanceTracer> MeshDistance::tracer_with(SearchDevice& device) const {
    const NarrowTree tree = tree_.narrowed();
    auto search = device.put(tree);
    return search ? std::make_unique<DeviceTracer>(*this, tree, std::move(search)) : nullptr;
}

} // namespace

std::shared_ptr<const ExactDistance> mesh_distance(const Mesh& mesh, Log* log) {
    if (mesh.triangles.empty()) {
        throw InputError("the mesh has no triangle, so there is no solid to be an occluder");
    }
    auto distance = std::make_shared<MeshDistance>(mesh.positions, mesh.triangles);
    if (distance->tangled()) {
        const std::vector<Triangle> once = each_once(mesh.positions, mesh.triangles);
        std::vector<Triangle> mended = oriented_alike(mesh.positions, once);
        if (mended != mesh.triangles) {
            distance = std::make_shared<MeshDistance>(mesh.positions, std::move(mended));
        }
    }
    if (log != nullptr) {
        warn_about_solid(mesh, distance->crossing_triangles(), *log);
    }
    return distance;
}

} // namespace anvil
