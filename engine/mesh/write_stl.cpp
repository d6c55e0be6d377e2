#include "engine/mesh/mesh_output.h"
#include "engine/mesh/scale.h"

namespace anvil {

namespace {

/// Unit normal, or zero for a triangle without area.
Vec3 facet_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 extent = glm::abs(b - a) + glm::abs(c - a);
    const double scale = unit_scale(extent.x + extent.y + extent.z);
    const Vec3 normal = glm::cross(scale * (b - a), scale * (c - a));
    const double length = glm::length(normal);
    return length > 0 ? normal / length : Vec3{0};
}

void append_vector(std::string& bytes, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) {
        append_bytes(bytes, static_cast<float>(v[axis]));
    }
}

} // namespace

std::string format_stl(const MeshOutput& output) {
    const Mesh& mesh = output.mesh;
    const std::array<const char*, 1> attribute_name = {"attribute"};
    const std::vector<const Column*> attribute = find_columns(mesh.polygon_columns, attribute_name);
    // A header that begins with "solid" would make some programs take the file for text.
    std::string bytes = "binary STL, little-endian";
    bytes.reserve(84 + 50 * mesh.triangles.size());
    bytes.resize(80, ' ');
    append_bytes(bytes, static_cast<uint32_t>(mesh.triangles.size()));
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const double word = attribute.empty() ? 0 : std::clamp(attribute[0]->values[f], 0.0, 65535.0);
        for (size_t t = mesh.first_triangle(f); t < mesh.first_triangle(f + 1); ++t) {
            const Triangle& triangle = mesh.triangles[t];
            const Vec3& a = output.positions[triangle[0]];
            const Vec3& b = output.positions[triangle[1]];
            const Vec3& c = output.positions[triangle[2]];
            append_vector(bytes, facet_normal(a, b, c));
            append_vector(bytes, a);
            append_vector(bytes, b);
            append_vector(bytes, c);
            append_bytes(bytes, static_cast<uint16_t>(word));
        }
    }
    return bytes;
}

} // namespace anvil
