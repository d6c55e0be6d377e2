#include "engine/distance/source_seeds.h"

#include "engine/core/error.h"

namespace anvil {
namespace {

constexpr double snap = 1e-12;

[[noreturn]] void reject(const char* kind, size_t source, const std::string& found, const std::string& mend) {
    throw InputError("distance " + std::string(kind) + " " + std::to_string(source) + ": " + found + "; " +
                     mend);
}

void check(const TriangleGraph& graph, const SurfacePoint& point, const char* kind, size_t index) {
    if (point.triangle == no_index) {
        if (point.vertex >= graph.vertex_count()) {
            reject(kind, index, "vertex " + std::to_string(point.vertex) + " is not in the mesh",
                   "the mesh has " + std::to_string(graph.vertex_count()) + " vertices, counted from 0");
        }
        return;
    }
    if (point.triangle >= graph.triangle_count()) {
        reject(kind, index, "triangle " + std::to_string(point.triangle) + " is not in the mesh",
               "the mesh has " + std::to_string(graph.triangle_count()) + " triangles, counted from 0");
    }
    const Vec3& w = point.barycentric;
    const double sum = w.x + w.y + w.z;
    if (!(w.x >= -snap && w.y >= -snap && w.z >= -snap && std::abs(sum - 1) <= 1e-6)) {
        reject(kind, index, "its barycentric weights are no point of the triangle",
               "give three weights >= 0 with sum 1");
    }
}

} // namespace

PlacedPoint placed(const TriangleGraph& graph, const SurfacePoint& point, const char* kind, size_t index) {
    check(graph, point, kind, index);
    PlacedPoint result;
    if (point.triangle == no_index) {
        result.vertex = graph.numbering.new_vertex[point.vertex];
        return result;
    }
    Vec3 weights = glm::max(point.barycentric, Vec3(0));
    weights /= weights.x + weights.y + weights.z;
    const uint32_t first = 3 * graph.numbering.new_triangle[point.triangle];
    for (int k = 0; k < 3; ++k) {
        if (weights[k] >= 1 - snap) {
            result.vertex = graph.corner_vertex[first + k];
            return result;
        }
    }
    for (int k = 0; k < 3; ++k) {
        if (weights[k] <= snap) {
            result.base = first + (k + 1) % 3;
            result.weight_end = weights[(k + 2) % 3];
            result.on_base = true;
            return result;
        }
    }
    result.base = first;
    result.weight_end = weights[1];
    result.weight_apex = weights[2];
    return result;
}

std::array<PlanePoint, 3> laid_out(const TriangleGraph& graph, uint32_t base) {
    const double length = graph.length(base);
    const double left = graph.length(TriangleGraph::previous(base));
    const PlanePoint along = direction_of_apex(graph, base);
    return {PlanePoint{0, 0}, PlanePoint{length, 0}, PlanePoint{left * along.x, left * along.y}};
}

std::optional<PlanePoint> place_in(const TriangleGraph& graph, const PlacedPoint& point, uint32_t base) {
    const std::array<PlanePoint, 3> c = laid_out(graph, base);
    const std::array<uint32_t, 3> sides = {base, TriangleGraph::next(base), TriangleGraph::previous(base)};
    const auto mixed = [&](const PlanePoint& a, const PlanePoint& b, double t) {
        return PlanePoint{(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y};
    };
    for (size_t k = 0; k < 3; ++k) {
        if (point.vertex != no_index) {
            if (graph.from(sides[k]) == point.vertex) {
                return c[k];
            }
        } else if (point.base == sides[k]) {
            const PlanePoint on_base =
                mixed(c[k], c[(k + 1) % 3], point.weight_end / (1 - point.weight_apex));
            return mixed(on_base, c[(k + 2) % 3], point.weight_apex);
        }
    }
    for (size_t k = 0; k < 3 && point.on_base; ++k) {
        for (const LikeSide& like : sides_of_edge(graph, point.base)) {
            if (like.side == sides[k]) {
                return mixed(c[k], c[(k + 1) % 3], like.same_way ? point.weight_end : 1 - point.weight_end);
            }
        }
    }
    return std::nullopt;
}

std::vector<uint32_t> triangles_with(const TriangleGraph& graph, const PlacedPoint& point) {
    std::vector<uint32_t> bases;
    if (point.vertex != no_index) {
        const std::span<const uint32_t> sides = graph.sides_leaving(point.vertex);
        bases.assign(sides.begin(), sides.end());
    } else if (point.on_base) {
        for (const LikeSide& side : sides_of_edge(graph, point.base)) {
            bases.push_back(side.side);
        }
    } else {
        bases.push_back(point.base);
    }
    return bases;
}

void seed_corners(const TriangleGraph& graph, uint32_t base, const std::array<PlanePoint, 3>& feet, Seed like,
                  std::vector<Seed>& seeds) {
    const std::array<PlanePoint, 3> corners = laid_out(graph, base);
    const std::array<uint32_t, 3> sides = {base, TriangleGraph::next(base), TriangleGraph::previous(base)};
    for (size_t k = 0; k < 3; ++k) {
        const PlanePoint& here = corners[k];
        const PlanePoint& next = corners[(k + 1) % 3];
        const double ax = next.x - here.x, ay = next.y - here.y;
        const double bx = feet[k].x - here.x, by = feet[k].y - here.y;
        like.vertex = graph.corner_vertex[sides[k]];
        like.side = sides[k];
        like.distance = std::hypot(bx, by);
        like.angle = std::atan2(std::max(0.0, ax * by - ay * bx), ax * bx + ay * by);
        seeds.push_back(like);
    }
}

std::vector<LikeSide> sides_of_edge(const TriangleGraph& graph, uint32_t side) {
    const uint32_t from = graph.from(side), to = graph.to(side);
    std::vector<LikeSide> sides;
    for (const uint32_t leaving : graph.sides_leaving(from)) {
        if (graph.to(leaving) == to) {
            sides.push_back({leaving, true});
        } else if (graph.apex(leaving) == to) {
            sides.push_back({TriangleGraph::previous(leaving), false});
        }
    }
    return sides;
}

void seed_point(const TriangleGraph& graph, const PlacedPoint& point, uint32_t label,
                std::vector<Seed>& seeds) {
    if (point.vertex != no_index) {
        seeds.push_back({point.vertex, label, 0, no_index, 0, false});
        return;
    }
    const auto seed = [&](uint32_t base, double weight_end) {
        const std::array<PlanePoint, 3> c = laid_out(graph, base);
        const PlanePoint at{weight_end * c[1].x + point.weight_apex * c[2].x, point.weight_apex * c[2].y};
        Seed like;
        like.label = label;
        seed_corners(graph, base, {at, at, at}, like, seeds);
    };
    if (!point.on_base) {
        seed(point.base, point.weight_end);
        return;
    }
    for (const LikeSide& side : sides_of_edge(graph, point.base)) {
        seed(side.side, side.same_way ? point.weight_end : 1 - point.weight_end);
    }
}

} // namespace anvil
