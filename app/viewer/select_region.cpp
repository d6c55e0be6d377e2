#include "app/viewer/select_region.h"

#include "engine/core/parallel_for.h"
#include "engine/edit/face_address.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr double vertex_pixels = 8;
constexpr double seen_slack = 1e-6; ///< of the way from the eye: a vertex does not hide itself
constexpr size_t grain = 2048;

struct Rectangle {
    Cursor low{infinity, infinity};
    Cursor high{-infinity, -infinity};

    explicit Rectangle(std::span<const Cursor> points) {
        for (const Cursor& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }

    bool contains(double x, double y) const { return x >= low.x && x <= high.x && y >= low.y && y <= high.y; }
};

bool seen(const OrbitCamera& camera, const ScreenPoint& at, uint32_t vertex, const PickSurface& surface) {
    const Ray ray = camera.ray(at.x, at.y);
    const ClosestPoint hit = surface.first_hit(ray);
    if (!hit.found()) {
        return true;
    }
    const Triangle& corners = surface.mesh().triangles[hit.triangle];
    const double away = glm::dot(surface.positions()[vertex] - ray.origin, ray.direction);
    return std::find(corners.begin(), corners.end(), vertex) != corners.end() ||
           hit.distance >= away * (1 - seen_slack);
}

} // namespace

bool within(std::span<const Cursor> outline, double x, double y) {
    bool inside = false;
    for (size_t i = 0; i < outline.size(); ++i) {
        const Cursor& a = outline[i];
        const Cursor& b = outline[(i + 1) % outline.size()];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside;
}

std::vector<uint32_t> vertices_within(const OrbitCamera& camera, std::span<const Cursor> outline,
                                      const PickSurface& surface, bool through) {
    const Rectangle bounds(outline);
    const std::span<const Vec3> positions = surface.positions();
    std::vector<uint8_t> found(positions.size(), 0);
    parallel_for(positions.size(), grain, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            const ScreenPoint at = camera.project(positions[v]);
            found[v] = at.visible() && bounds.contains(at.x, at.y) && within(outline, at.x, at.y) &&
                       (through || seen(camera, at, static_cast<uint32_t>(v), surface));
        }
    });
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < found.size(); ++v) {
        if (found[v] != 0) {
            vertices.push_back(v);
        }
    }
    return vertices;
}

std::vector<uint32_t> vertices_under(const OrbitCamera& camera, const Cursor& at,
                                     const PickSurface& surface) {
    const ClosestPoint hit = surface.first_hit(camera.ray(at.x, at.y));
    if (!hit.found()) {
        return {};
    }
    const Mesh& mesh = surface.mesh();
    for (const uint32_t v : mesh.triangles[hit.triangle]) {
        const ScreenPoint corner = camera.project(surface.positions()[v]);
        if (std::hypot(corner.x - at.x, corner.y - at.y) <= vertex_pixels) {
            return {v};
        }
    }
    const std::span<const uint32_t> face =
        mesh.polygon(face_address(mesh, {hit.triangle, hit.barycentric}).face);
    return {face.begin(), face.end()};
}

} // namespace anvil
