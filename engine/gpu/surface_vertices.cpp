#include "engine/gpu/surface_vertices.h"

#include "engine/core/error.h"
#include "engine/mesh/incidence.h"

namespace anvil {

namespace {

constexpr float crease_cosine = 0.643F; // 50 degrees between two faces
constexpr float smooth_cosine = 0.906F; // 25 degrees from the vertex normal: no two faces can form a crease

bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Unnormalized: length is twice the area, so that sums are area-weighted.
glm::vec3 face_normal(const PictureSurface& surface, const Triangle& t) {
    const Vec3 a = surface.positions[t[0]];
    const Vec3 b = surface.positions[t[1]];
    const Vec3 c = surface.positions[t[2]];
    return glm::vec3(glm::cross(b - a, c - a));
}

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::vec3(0);
}

void check(const PictureSurface& surface) {
    const size_t n = surface.positions.size();
    const bool counts = (surface.tint.empty() || surface.tint.size() == n) &&
                        (surface.colours.empty() || surface.colours.size() == n);
    bool indices = true;
    for (const Triangle& t : surface.triangles) {
        indices = indices && t[0] < n && t[1] < n && t[2] < n;
    }
    if (!counts || !indices) {
        throw InternalError("a surface to draw has a wrong index or a wrong number of attributes");
    }
}

std::array<uint8_t, 4> packed(const glm::vec3& colour) {
    const glm::vec3 c = glm::clamp(colour, 0.0F, 1.0F) * 255.0F + 0.5F;
    return {static_cast<uint8_t>(c.x), static_cast<uint8_t>(c.y), static_cast<uint8_t>(c.z), 255};
}

std::vector<Triangle> drawable_triangles(const PictureSurface& surface) {
    std::vector<Triangle> triangles;
    triangles.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        if (is_finite(surface.positions[t[0]]) && is_finite(surface.positions[t[1]]) &&
            is_finite(surface.positions[t[2]])) {
            triangles.push_back(t);
        }
    }
    return triangles;
}

} // namespace

Box bounds(const PictureSurface& surface) {
    Box box;
    for (const glm::vec3& p : surface.positions) {
        if (is_finite(p)) {
            box.include(Vec3(p));
        }
    }
    return box;
}

SurfaceGeometry surface_geometry(const PictureSurface& surface, const glm::dmat4& view) {
    check(surface);
    const std::vector<Triangle> triangles = drawable_triangles(surface);
    const Incidence incidence = incident_triangles(triangles, surface.positions.size());
    std::vector<glm::vec3> areas;
    areas.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        areas.push_back(face_normal(surface, t));
    }
    const auto turn = glm::mat3(glm::dmat3(view));
    SurfaceGeometry geometry;
    const auto add_vertex = [&](uint32_t v, const glm::vec3& normal) {
        geometry.vertices.push_back(
            {glm::vec3(view * glm::dvec4(Vec3(surface.positions[v]), 1)), turn * normal,
             surface.tint.empty() ? 0.0F : surface.tint[v],
             packed(surface.colours.empty() ? surface.base_colour : surface.colours[v])});
        return static_cast<uint32_t>(geometry.vertices.size() - 1);
    };
    std::vector<bool> smooth(surface.positions.size(), true);
    geometry.vertices.reserve(surface.positions.size());
    for (uint32_t v = 0; v < surface.positions.size(); ++v) {
        glm::vec3 normal(0);
        for (const uint32_t f : incidence.at(v)) {
            normal += areas[f];
        }
        normal = unit(normal);
        for (const uint32_t f : incidence.at(v)) {
            smooth[v] = smooth[v] && glm::dot(unit(areas[f]), normal) >= smooth_cosine;
        }
        add_vertex(v, normal);
    }
    geometry.indices.reserve(3 * triangles.size());
    for (uint32_t f = 0; f < triangles.size(); ++f) {
        const glm::vec3 flat = unit(areas[f]);
        for (const uint32_t v : triangles[f]) {
            if (smooth[v]) {
                geometry.indices.push_back(v);
                continue;
            }
            glm::vec3 normal(0);
            for (const uint32_t g : incidence.at(v)) {
                if (g == f || glm::dot(unit(areas[g]), flat) >= crease_cosine) {
                    normal += areas[g];
                }
            }
            geometry.indices.push_back(add_vertex(v, unit(normal)));
        }
    }
    return geometry;
}

} // namespace anvil
