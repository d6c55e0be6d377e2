#include "engine/occluder/mesh_distance.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/closest_points.h"
#include "engine/mesh/triangle_search.h"
#include "engine/occluder/face_orientation.h"
#include "engine/occluder/side_anchors.h"
#include "engine/occluder/solid_warnings.h"
#include "engine/occluder/surface_sides.h"
#include "engine/occluder/winding_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace anvil {

namespace {

class MeshDistance final : public ExactDistance {
  public:
    MeshDistance(std::span<const Vec3> positions, std::vector<Triangle> triangles)
        : triangles_(std::move(triangles)), positions_(positions.begin(), positions.end()),
          tree_(positions_, triangles_), winding_(positions_, triangles_),
          sides_(positions_, triangles_, tree_, winding_), boundary_(sides_.take_boundary()) {
        for (const Triangle& t : triangles_) {
            for (uint32_t v : t) {
                bounds_.include(positions_[v]);
            }
        }
    }

    SignedDistance at(const Vec3& p) const override {
        const ClosestPoint closest = tree_.closest(p);
        if (on_surface(closest)) {
            return beside_surface(p, closest);
        }
        const std::optional<bool> told = told_inside(p, closest);
        return signed_distance(p, closest, told ? *told : wound_around(p));
    }

    std::unique_ptr<DistanceTracer> tracer() const override { return std::make_unique<Tracer>(*this); }

    std::unique_ptr<DistanceTracer> tracer_with(SearchDevice& device) const override;

    Box bounds() const override { return bounds_; }

    size_t crossing_triangles() const { return sides_.crossing_triangles(); }
    /// Whether faces may be flipped or there twice.
    bool tangled() const { return sides_.tangled(); }

  private:
    /// Signs the distances of many points, on one thread.
    class Signer {
      public:
        explicit Signer(const MeshDistance& solid)
            : solid_(solid), anchors_(solid.winding_, solid.boundary_, solid.rounding()) {}

        void sign(std::span<const Vec3> points, std::span<const ClosestPoint> closest,
                  std::span<SignedDistance> found) {
            untold_.clear();
            for (size_t i = 0; i < points.size(); ++i) {
                if (solid_.on_surface(closest[i])) {
                    found[i] = solid_.beside_surface(points[i], closest[i]);
                } else if (const auto told = solid_.told_inside(points[i], closest[i])) {
                    found[i] = signed_distance(points[i], closest[i], *told);
                } else {
                    untold_.emplace_back(-std::ilogb(closest[i].distance), i);
                }
            }
            // The farthest first, as anchors; about as far ones as they come, which is side by side.
            std::sort(untold_.begin(), untold_.end());
            for (const auto& [nearness, i] : untold_) {
                found[i] =
                    signed_distance(points[i], closest[i], anchors_.inside(points[i], closest[i].distance));
            }
        }

      private:
        const MeshDistance& solid_;
        SideAnchors anchors_;
        std::vector<std::pair<int, size_t>> untold_; ///< nearness in octaves, and point
    };

    class Tracer final : public DistanceTracer {
      public:
        explicit Tracer(const MeshDistance& solid) : solid_(solid), nearest_(solid.tree_), signer_(solid) {}

        void trace(std::span<const Vec3> points, std::span<SignedDistance> found) override {
            closest_.resize(points.size());
            nearest_.closest(points, closest_);
            for (const ClosestPoint& closest : closest_) {
                solid_.sides_.prefetch(closest);
            }
            signer_.sign(points, closest_, found);
        }

      private:
        const MeshDistance& solid_;
        ClosestPointTracer nearest_;
        Signer signer_;
        std::vector<ClosestPoint> closest_;
    };

    class DeviceTracer;

    /// Too near for the direction to tell anything.
    bool on_surface(const ClosestPoint& closest) const {
        return !(closest.distance > 1e-9 * bounds_.diagonal());
    }

    SignedDistance beside_surface(const Vec3& p, const ClosestPoint& closest) const {
        const bool inside = !beyond_bounds(p) && wound_around(p);
        return {inside ? -closest.distance : closest.distance, outward_normal(closest)};
    }

    static SignedDistance signed_distance(const Vec3& p, const ClosestPoint& closest, bool inside) {
        const double sign = inside ? -1 : 1;
        return {sign * closest.distance, sign / closest.distance * (p - closest.position)};
    }

    bool beyond_bounds(const Vec3& p) const {
        return glm::any(glm::lessThan(p, bounds_.low)) || glm::any(glm::greaterThan(p, bounds_.high));
    }

    bool wound_around(const Vec3& p) const { return std::abs(winding_.at(p)) > 0.5; }

    /// Where that takes no winding number.
    std::optional<bool> told_inside(const Vec3& p, const ClosestPoint& closest) const {
        if (beyond_bounds(p)) {
            return false;
        }
        const std::optional<int> told = sides_.winding(p, closest);
        return told ? std::optional(*told != 0) : std::nullopt;
    }

    /// More than distances to the surface are off, those to slivers included.
    double rounding() const {
        const Vec3 far = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
        return 1e-12 * std::max({far.x, far.y, far.z});
    }

    /// The face's normal, on the side that is not inside.
    Vec3 outward_normal(const ClosestPoint& closest) const {
        const Triangle& t = triangles_[closest.triangle];
        const Vec3 area =
            glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
        const double size = glm::length(area);
        const Vec3 normal = size > 0 ? area / size : Vec3(0, 1, 0);
        const double step = 1e-4 * bounds_.diagonal();
        const auto inside = [this](const Vec3& p) { return !beyond_bounds(p) && wound_around(p); };
        return inside(closest.position + step * normal) && !inside(closest.position - step * normal) ? -normal
                                                                                                     : normal;
    }

    std::vector<Triangle> triangles_;
    std::vector<Vec3> positions_;
    SearchTree tree_;
    WindingNumber winding_;
    SurfaceSides sides_;
    SurfaceBoundary boundary_;
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
        std::vector<ClosestPoint> closest(points.size());
        for (size_t i = 0; i < points.size(); ++i) {
            const auto end = std::find(near[i].begin(), near[i].end(), kernel::f32::NO_TRIANGLE);
            const std::span<const uint32_t> slots(near[i].begin(), end);
            const SearchTree& tree = solid_.tree_;
            closest[i] = slots.empty() ? tree.closest(points[i]) : tree.closest_of(points[i], slots);
        }
        Signer(solid_).sign(points, closest, found);
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
