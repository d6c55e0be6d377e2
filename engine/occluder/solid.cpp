#include "engine/occluder/solid.h"

#include "engine/mesh/mesh_reader.h"
#include "engine/occluder/level_set_file.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/shape_nodes.h"

#include <algorithm>
#include <optional>

namespace anvil {

namespace {

class PlacedDistance final : public ExactDistance {
  public:
    PlacedDistance(std::shared_ptr<const ExactDistance> solid, const Placement& place)
        : solid_(std::move(solid)), place_(place) {}

    SignedDistance at(const Vec3& p) const override { return placed(solid_->at(local(p))); }

    std::unique_ptr<DistanceTracer> tracer() const override {
        return std::make_unique<Tracer>(*this, solid_->tracer());
    }

    std::unique_ptr<DistanceTracer> tracer_with(SearchDevice& device) const override {
        auto tracer = solid_->tracer_with(device);
        return tracer ? std::make_unique<Tracer>(*this, std::move(tracer)) : nullptr;
    }

    Box bounds() const override {
        const Box local = solid_->bounds();
        if (local.empty() || !is_finite(local.low) || !is_finite(local.high)) {
            return local;
        }
        Box box;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p(corner & 1 ? local.high.x : local.low.x, corner & 2 ? local.high.y : local.low.y,
                         corner & 4 ? local.high.z : local.low.z);
            box.include(place_.origin +
                        place_.scale * (place_.axes[0] * p.x + place_.axes[1] * p.y + place_.axes[2] * p.z));
        }
        return box;
    }

  private:
    class Tracer final : public DistanceTracer {
      public:
        Tracer(const PlacedDistance& solid, std::unique_ptr<DistanceTracer> local)
            : solid_(solid), local_(std::move(local)) {}

        void trace(std::span<const Vec3> points, std::span<SignedDistance> found) override {
            points_.resize(points.size());
            std::transform(points.begin(), points.end(), points_.begin(),
                           [this](const Vec3& p) { return solid_.local(p); });
            local_->trace(points_, found);
            std::transform(found.begin(), found.end(), found.begin(),
                           [this](const SignedDistance& s) { return solid_.placed(s); });
        }

      private:
        const PlacedDistance& solid_;
        std::unique_ptr<DistanceTracer> local_;
        std::vector<Vec3> points_;
    };

    Vec3 local(const Vec3& p) const {
        const Vec3 arm = (p - place_.origin) / place_.scale;
        const auto& [x, y, z] = place_.axes;
        return {glm::dot(x, arm), glm::dot(y, arm), glm::dot(z, arm)};
    }
    SignedDistance placed(const SignedDistance& s) const {
        const auto& [x, y, z] = place_.axes;
        return {s.distance * place_.scale, x * s.normal.x + y * s.normal.y + z * s.normal.z};
    }

    std::shared_ptr<const ExactDistance> solid_;
    Placement place_;
};

/// Boolean operation of solids that have no common formula.
class BooleanDistance final : public ExactDistance {
  public:
    BooleanDistance(CsgOperation operation, std::vector<std::shared_ptr<const ExactDistance>> parts)
        : operation_(operation), parts_(std::move(parts)) {}

    SignedDistance at(const Vec3& p) const override {
        SignedDistance result = parts_.front()->at(p);
        for (size_t i = 1; i < parts_.size(); ++i) {
            SignedDistance next = parts_[i]->at(p);
            if (operation_ == CsgOperation::subtract) {
                next = {-next.distance, -next.normal};
            }
            const bool takes = operation_ == CsgOperation::unite ? next.distance < result.distance
                                                                 : next.distance > result.distance;
            result = takes ? next : result;
        }
        return result;
    }

    Box bounds() const override {
        Box box = parts_.front()->bounds();
        for (size_t i = 1; i < parts_.size() && operation_ != CsgOperation::subtract; ++i) {
            const Box next = parts_[i]->bounds();
            box = operation_ == CsgOperation::unite
                      ? Box{glm::min(box.low, next.low), glm::max(box.high, next.high)}
                      : Box{glm::max(box.low, next.low), glm::min(box.high, next.high)};
        }
        const bool empty = glm::any(glm::greaterThan(box.low, box.high));
        return empty ? Box{} : box;
    }

  private:
    CsgOperation operation_;
    std::vector<std::shared_ptr<const ExactDistance>> parts_;
};

void pass_on(const Log& log, const std::string& file, const SolidSource& source) {
    if (source.log != nullptr) {
        for (const std::string& warning : log.warnings) {
            std::string message = file;
            message += ": ";
            message += warning;
            source.log->warn(message);
        }
    }
}

std::string described(const MeshShape& mesh) {
    return "occluder mesh " + mesh.file;
}

/// The surface that a shape's file holds; nothing if the shape is none of a file.
std::optional<Mesh> read_solid(const OccluderShape& shape, const SolidSource& source) {
    Log log;
    std::optional<Mesh> surface;
    if (const auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
        surface = read_mesh(source.folder / mesh->file, log);
        pass_on(log, described(*mesh), source);
    } else if (const auto* vdb = std::get_if<VdbShape>(&shape.solid)) {
        surface = read_level_set(source.folder / vdb->file, vdb->grid, log);
        pass_on(log, "occluder " + vdb->file, source);
    }
    return surface;
}

} // namespace

std::shared_ptr<const ExactDistance> placed(std::shared_ptr<const ExactDistance> solid,
                                            const Transform& transform) {
    return std::make_shared<PlacedDistance>(std::move(solid), placement(transform));
}

std::shared_ptr<const ExactDistance> solid_distance(const OccluderShape& shape, const SolidSource& source) {
    if (has_formula(shape)) {
        return formula_distance(shape_nodes(shape));
    }
    if (const std::optional<Mesh> surface = read_solid(shape, source)) {
        Log log;
        auto distance = mesh_distance(*surface, &log);
        if (const auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
            pass_on(log, described(*mesh), source);
        }
        return distance;
    }
    const auto& csg = std::get<CsgShape>(shape.solid);
    std::vector<std::shared_ptr<const ExactDistance>> parts;
    std::transform(csg.parts.begin(), csg.parts.end(), std::back_inserter(parts), [&](const CsgPart& part) {
        return placed(solid_distance(part.shape, source), part.transform);
    });
    return std::make_shared<BooleanDistance>(csg.operation, std::move(parts));
}

std::shared_ptr<const ExactDistance> true_distance(const OccluderShape& shape, const SolidSource& source,
                                                   int cells) {
    auto solid = solid_distance(shape, source);
    constexpr int least_cells = 96;
    return std::holds_alternative<CsgShape>(shape.solid) ? redistanced(solid, std::max(cells, least_cells))
                                                         : solid;
}

Mesh solid_surface(const OccluderShape& shape, const SolidSource& source, int cells) {
    if (std::optional<Mesh> surface = read_solid(shape, source)) {
        return *std::move(surface);
    }
    return surface_of(*solid_distance(shape, source), cells);
}

} // namespace anvil
