#include "engine/occluder/solid.h"

#include "engine/mesh/mesh_reader.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/shape_nodes.h"

#include <algorithm>

namespace anvil {

namespace {

/// A part at its place within a Boolean shape.
struct PlacedPart {
    std::shared_ptr<const ExactDistance> solid;
    Placement place;

    SignedDistance at(const Vec3& p) const {
        const Vec3 arm = (p - place.origin) / place.scale;
        const auto& [x, y, z] = place.axes;
        const SignedDistance s = solid->at(Vec3(glm::dot(x, arm), glm::dot(y, arm), glm::dot(z, arm)));
        return {s.distance * place.scale, x * s.normal.x + y * s.normal.y + z * s.normal.z};
    }

    Box bounds() const {
        const Box local = solid->bounds();
        if (local.empty() || !is_finite(local.low) || !is_finite(local.high)) {
            return local;
        }
        Box box;
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p(corner & 1 ? local.high.x : local.low.x, corner & 2 ? local.high.y : local.low.y,
                         corner & 4 ? local.high.z : local.low.z);
            box.include(place.origin +
                        place.scale * (place.axes[0] * p.x + place.axes[1] * p.y + place.axes[2] * p.z));
        }
        return box;
    }
};

/// Boolean operation of solids that have no common formula.
class BooleanDistance final : public ExactDistance {
  public:
    BooleanDistance(CsgOperation operation, std::vector<PlacedPart> parts)
        : operation_(operation), parts_(std::move(parts)) {}

    SignedDistance at(const Vec3& p) const override {
        SignedDistance result = parts_.front().at(p);
        for (size_t i = 1; i < parts_.size(); ++i) {
            SignedDistance next = parts_[i].at(p);
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
        Box box = parts_.front().bounds();
        for (size_t i = 1; i < parts_.size() && operation_ != CsgOperation::subtract; ++i) {
            const Box next = parts_[i].bounds();
            box = operation_ == CsgOperation::unite
                      ? Box{glm::min(box.low, next.low), glm::max(box.high, next.high)}
                      : Box{glm::max(box.low, next.low), glm::min(box.high, next.high)};
        }
        const bool empty = glm::any(glm::greaterThan(box.low, box.high));
        return empty ? Box{} : box;
    }

  private:
    CsgOperation operation_;
    std::vector<PlacedPart> parts_;
};

Mesh read_solid_mesh(const MeshShape& shape, const SolidSource& source) {
    Log log;
    Mesh mesh = read_mesh(source.folder / shape.file, log);
    if (source.log != nullptr) {
        for (const std::string& warning : log.warnings) {
            source.log->warn("occluder mesh " + shape.file + ": " + warning);
        }
    }
    return mesh;
}

} // namespace

std::shared_ptr<const ExactDistance> solid_distance(const OccluderShape& shape, const SolidSource& source) {
    if (has_formula(shape)) {
        return formula_distance(shape_nodes(shape));
    }
    if (const auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
        return mesh_distance(read_solid_mesh(*mesh, source));
    }
    const auto& csg = std::get<CsgShape>(shape.solid);
    std::vector<PlacedPart> parts;
    std::transform(csg.parts.begin(), csg.parts.end(), std::back_inserter(parts), [&](const CsgPart& part) {
        return PlacedPart{solid_distance(part.shape, source), placement(part.transform)};
    });
    return std::make_shared<BooleanDistance>(csg.operation, std::move(parts));
}

Mesh solid_surface(const OccluderShape& shape, const SolidSource& source, int cells) {
    if (const auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
        return read_solid_mesh(*mesh, source);
    }
    return surface_of(*solid_distance(shape, source), cells);
}

} // namespace anvil
