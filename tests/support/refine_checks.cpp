#include "tests/support/refine_checks.h"

#include "engine/distance/distance.h"

#include <map>

namespace anvil::test {

namespace {

double source_distance(double d0, double d1, double length, double s) {
    if (std::abs(d0 - d1) >= length) {
        return d0 + (d1 - d0) * s / length;
    }
    if (d0 + d1 < length * (1 - 1e-5)) {
        return std::min(d0 + s, d1 + length - s);
    }
    const double x = (d0 * d0 - d1 * d1 + length * length) / (2 * length);
    return std::hypot(s - x, std::sqrt(std::max(0.0, d0 * d0 - x * x)));
}

double edge_error(const HandleField& handle, uint32_t a, uint32_t b, double length, int samples) {
    const auto weight = [&](double s) {
        double least = infinity;
        for (const AnchorField& anchor : handle.anchors) {
            if (std::isfinite(anchor.distances[a]) && std::isfinite(anchor.distances[b])) {
                least = std::min(least, source_distance(anchor.distances[a], anchor.distances[b], length, s));
            }
        }
        return handle.shape(least / handle.radius);
    };
    const double start = weight(0);
    const double end = weight(length);
    double most = 0;
    for (int i = 1; i < samples; ++i) {
        const double part = static_cast<double>(i) / samples;
        most = std::max(most, std::abs(weight(part * length) - (start + part * (end - start))));
    }
    return most;
}

std::map<std::pair<uint32_t, uint32_t>, int> edge_uses(const Mesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            ++uses[std::minmax(t[i], t[(i + 1) % 3])];
        }
    }
    return uses;
}

Vec3 normal_of(const Mesh& mesh, const Triangle& t) {
    return glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                      mesh.positions[t[2]] - mesh.positions[t[0]]);
}

} // namespace

HandleField field_from(const Mesh& mesh, const std::vector<uint32_t>& vertices, const std::string& preset,
                       double radius) {
    HandleField handle{ShapeFunction(preset_knots(preset)), radius, 0, {}};
    const GeodesicSolver solver(mesh, mesh.positions);
    std::vector<Vec3> places;
    for (const uint32_t v : vertices) {
        places.push_back(mesh.positions[v]);
    }
    const double reach = needed_reach(mesh.triangles, mesh.positions, places, radius);
    for (const uint32_t v : vertices) {
        const SurfacePoint source = vertex_point(mesh, v);
        const DistanceField field = solver.solve({&source, 1}, reach, DistanceMethod::exact);
        handle.anchors.push_back({field.dense(mesh.vertex_count()), SourceKind::point, std::nullopt});
    }
    return handle;
}

RefineState state_of(const Mesh& mesh, std::vector<HandleField> handles) {
    return {mesh.positions, std::move(handles), {}};
}

double sampled_error(const Mesh& mesh, const std::vector<HandleField>& handles, int samples) {
    double most = 0;
    for (const auto& [edge, count] : edge_uses(mesh)) {
        const double length = glm::distance(mesh.positions[edge.first], mesh.positions[edge.second]);
        for (const HandleField& handle : handles) {
            most = std::max(most, edge_error(handle, edge.first, edge.second, length, samples));
        }
    }
    return most;
}

size_t count_flipped(const Mesh& before, const RefinedMesh& after) {
    size_t count = 0;
    for (size_t t = 0; t < after.mesh.triangles.size(); ++t) {
        const Vec3 old_normal = normal_of(before, before.triangles[after.roots[t]]);
        // A triangle that had no area has no way to look.
        count += glm::length(old_normal) > 0 &&
                 !(glm::dot(normal_of(after.mesh, after.mesh.triangles[t]), old_normal) > 0);
    }
    return count;
}

double area_of(const Mesh& mesh) {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        area += glm::length(normal_of(mesh, t)) / 2;
    }
    return area;
}

double boundary_length(const Mesh& mesh) {
    double length = 0;
    for (const auto& [edge, count] : edge_uses(mesh)) {
        length += count == 1 ? glm::distance(mesh.positions[edge.first], mesh.positions[edge.second]) : 0;
    }
    return length;
}

Rim rim_of(const Mesh& mesh, const HandleField& handle, double distance, double off) {
    Rim rim;
    std::map<std::pair<uint32_t, uint32_t>, int> sides;
    for (const Triangle& t : mesh.triangles) {
        bool inside = false;
        bool outside = false;
        for (const uint32_t v : t) {
            inside |= handle.distance(v) < distance - off;
            outside |= handle.distance(v) > distance + off;
        }
        rim.crossed_triangles += inside && outside;
        for (int i = 0; i < 3; ++i) {
            sides[std::minmax(t[i], t[(i + 1) % 3])] |= outside ? 2 : 1;
        }
    }
    std::map<uint32_t, int> meets;
    for (const auto& [edge, side] : sides) {
        if (side == 3) {
            ++rim.edges;
            ++meets[edge.first];
            ++meets[edge.second];
        }
    }
    for (const auto& [v, count] : meets) {
        rim.odd_vertices += count % 2;
        rim.farthest = std::max(rim.farthest, std::abs(handle.distance(v) - distance));
    }
    return rim;
}

} // namespace anvil::test
