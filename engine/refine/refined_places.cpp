#include "engine/refine/refined_places.h"

#include "engine/core/error.h"

namespace anvil {

RootPlaces::RootPlaces(const Triangle& root, size_t first, std::span<const VertexParents> parents)
    : first_(first), parents_(parents) {
    for (int i = 0; i < 3; ++i) {
        Vec3 corner(0);
        corner[i] = 1;
        known_.emplace(root[i], corner);
    }
}

Vec3 RootPlaces::weights_of(uint32_t vertex) {
    const auto found = known_.find(vertex);
    if (found != known_.end()) {
        return found->second;
    }
    if (vertex < first_) {
        throw InternalError("vertex " + std::to_string(vertex) + " is no part of this triangle");
    }
    const VertexParents& p = parents_[vertex - first_];
    const Vec3 weights = between(weights_of(p.a), weights_of(p.b), p.place);
    known_.emplace(vertex, weights);
    return weights;
}

Vec3 RootPlaces::within(const Triangle& corners, const Vec3& weights) {
    const glm::dmat3 parts(weights_of(corners[0]), weights_of(corners[1]), weights_of(corners[2]));
    const double size = glm::determinant(parts);
    return size > 0 ? glm::inverse(parts) * weights : Vec3(-infinity);
}

void RefinementHistory::add(const RefinedMesh& refined) {
    parents_.insert(parents_.end(), refined.parents.begin(), refined.parents.end());
    std::vector<uint32_t> roots(refined.roots.size());
    for (size_t t = 0; t < roots.size(); ++t) {
        roots[t] = roots_.empty() ? refined.roots[t] : roots_[refined.roots[t]];
    }
    roots_ = std::move(roots);
}

SurfacePoint RefinementHistory::find(std::span<const Triangle> triangles, uint32_t first_triangle,
                                     const Vec3& weights) const {
    if (roots_.empty()) {
        return snapped({first_triangle, weights});
    }
    RootPlaces places(mesh_.triangles[first_triangle], mesh_.vertex_count(), parents_);
    SurfacePoint best;
    double deepest = -infinity;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (roots_[t] != first_triangle) {
            continue;
        }
        const Vec3 inside = places.within(triangles[t], weights);
        const double depth = std::min({inside.x, inside.y, inside.z});
        if (best.triangle == no_index || depth > deepest) {
            deepest = depth;
            best = {t, inside};
        }
    }
    return snapped(best);
}

SurfacePoint RefinementHistory::find_first(std::span<const Triangle> triangles,
                                           const SurfacePoint& point) const {
    if (roots_.empty()) {
        return snapped(point);
    }
    const uint32_t root = roots_[point.triangle];
    RootPlaces places(mesh_.triangles[root], mesh_.vertex_count(), parents_);
    const Triangle& corners = triangles[point.triangle];
    Vec3 weights(0);
    for (int i = 0; i < 3; ++i) {
        weights += point.barycentric[i] * places.weights_of(corners[i]);
    }
    return snapped({root, weights});
}

std::vector<uint32_t> RefinementHistory::parts_of(uint32_t first, uint32_t end) const {
    std::vector<uint32_t> parts;
    const auto count = static_cast<uint32_t>(roots_.empty() ? end : roots_.size());
    for (uint32_t t = roots_.empty() ? first : 0; t < count; ++t) {
        const uint32_t root = roots_.empty() ? t : roots_[t];
        if (root >= first && root < end) {
            parts.push_back(t);
        }
    }
    return parts;
}

} // namespace anvil
