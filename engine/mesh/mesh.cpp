#include "engine/mesh/mesh.h"

#include "engine/mesh/polygon_split.h"
#include "engine/mesh/scale.h"

namespace anvil {

void triangulate(Mesh& mesh) {
    PolygonSplitter splitter;
    std::vector<Vec3> points;
    mesh.triangles.clear();
    mesh.triangles.reserve(mesh.corners.size() - 2 * mesh.polygon_count());
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const std::span<const uint32_t> polygon = mesh.polygon(f);
        if (polygon.size() == 3) {
            mesh.triangles.push_back({polygon[0], polygon[1], polygon[2]});
            continue;
        }
        points.clear();
        for (const uint32_t v : polygon) {
            points.push_back(mesh.positions[v]);
        }
        for (const Triangle& t : splitter.split(points)) {
            mesh.triangles.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
        }
    }
}

Box bounds(const Mesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.positions) {
        box.include(p);
    }
    return box;
}

std::vector<Vec3> vertex_normals(const Mesh& mesh, std::span<const Vec3> positions) {
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    const double scale = unit_scale(box.diagonal());
    std::vector<Vec3> normals(positions.size(), Vec3{0});
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = scale * (positions[t[1]] - positions[t[0]]);
        const Vec3 b = scale * (positions[t[2]] - positions[t[0]]);
        const Vec3 doubled_area = glm::cross(a, b);
        for (const uint32_t v : t) {
            normals[v] += doubled_area;
        }
    }
    for (Vec3& n : normals) {
        // Two steps: the squared area of a tiny triangle in a large mesh may underflow.
        const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        if (largest > 0) {
            n = glm::normalize(n * unit_scale(largest));
        }
    }
    return normals;
}

} // namespace anvil
