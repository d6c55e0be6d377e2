#include "app/viewer/drawn_mesh.h"

#include "engine/core/parallel_for.h"
#include "engine/mesh/edge_list.h"
#include "engine/mesh/incidence.h"

namespace anvil {

namespace {

constexpr double least_outside = 0.3; ///< of all triangles: to copy pictures takes time too

std::vector<glm::vec3> relative(std::span<const Vec3> positions, const Vec3& origin) {
    std::vector<glm::vec3> narrow;
    narrow.reserve(positions.size());
    for (const Vec3& p : positions) {
        narrow.emplace_back(is_finite(p) ? p - origin : Vec3(0));
    }
    return narrow;
}

std::vector<uint32_t> triangle_indices(const Mesh& mesh, std::span<const Vec3> positions) {
    std::vector<uint32_t> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        if (is_finite(positions[t[0]]) && is_finite(positions[t[1]]) && is_finite(positions[t[2]])) {
            indices.insert(indices.end(), t.begin(), t.end());
        }
    }
    return indices;
}

std::vector<uint32_t> line_indices(const Mesh& mesh, std::span<const Vec3> positions) {
    const EdgeList edges = list_edges(mesh);
    std::vector<uint32_t> indices;
    indices.reserve(edges.uses.size());
    for (uint32_t low = 0; low + 1 < edges.begin.size(); ++low) {
        for (uint32_t i = edges.begin[low]; i < edges.begin[low + 1]; ++i) {
            const uint32_t high = edges.uses[i].high;
            const bool again = i > edges.begin[low] && edges.uses[i - 1].high == high;
            if (!again && is_finite(positions[low]) && is_finite(positions[high])) {
                indices.insert(indices.end(), {low, high});
            }
        }
    }
    return indices;
}

Buffer index_buffer(DeviceState& device, std::span<const uint32_t> indices) {
    Buffer buffer(device, std::max<uint64_t>(indices.size_bytes(), 4), vk::BufferUsageFlagBits::eIndexBuffer,
                  MemoryUse::device);
    buffer.write_all(indices);
    return buffer;
}

} // namespace

DrawnIndices::DrawnIndices(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places)
    : DrawnIndices(device, std::span<const uint32_t>(anvil::triangle_indices(mesh, places))) {
    const std::vector<uint32_t> ends = anvil::line_indices(mesh, places);
    lines = index_buffer(device, ends);
    line_indices = static_cast<uint32_t>(ends.size());
}

DrawnIndices::DrawnIndices(DeviceState& device, std::span<const uint32_t> corners)
    : triangles(index_buffer(device, corners)), triangle_indices(static_cast<uint32_t>(corners.size())) {}

SplitTriangles split_triangles(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places,
                               std::span<const uint32_t> vertices) {
    std::vector<bool> in_region(mesh.vertex_count(), false);
    for (const uint32_t v : vertices) {
        in_region[v] = true;
    }
    const std::vector<uint32_t> all = anvil::triangle_indices(mesh, places);
    std::vector<uint32_t> inside;
    std::vector<uint32_t> outside;
    for (size_t i = 0; i < all.size(); i += 3) {
        const bool at_region = in_region[all[i]] || in_region[all[i + 1]] || in_region[all[i + 2]];
        std::vector<uint32_t>& part = at_region ? inside : outside;
        part.insert(part.end(), &all[i], &all[i] + 3);
    }
    if (static_cast<double>(outside.size()) < least_outside * static_cast<double>(all.size())) {
        return {};
    }
    const auto indices = [&](const std::vector<uint32_t>& corners) {
        return std::make_shared<const DrawnIndices>(device, std::span<const uint32_t>(corners));
    };
    return {indices(inside), indices(outside)};
}

DrawnMesh::DrawnMesh(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places, const Vec3& centre,
                     bool editable)
    : origin(centre), indices(device, mesh, places) {
    for (const Vec3& p : places) {
        if (is_finite(p)) {
            box.include(p);
        }
    }
    positions = storage_buffer(device, std::span<const glm::vec3>(relative(places, origin)));
    const std::vector<Vec3> directions = vertex_normals(mesh, places);
    normals = storage_buffer(device, std::span<const glm::vec3>(relative(directions, Vec3(0))));
    if (editable) {
        slots =
            storage_buffer(device, std::span<const uint32_t>(std::vector<uint32_t>(places.size(), no_index)),
                           MemoryUse::upload);
    }
}

} // namespace anvil
