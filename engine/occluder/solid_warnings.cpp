#include "engine/occluder/solid_warnings.h"

#include "engine/mesh/health.h"

#include <string>

namespace anvil {

namespace {

/// What the faces enclose, seen from the middle so that a hole falsifies it little.
double signed_volume(const Mesh& mesh, const Vec3& middle) {
    double volume = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]] - middle;
        volume += glm::dot(a, glm::cross(mesh.positions[t[1]] - middle, mesh.positions[t[2]] - middle)) / 6;
    }
    return volume;
}

std::string counted(size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

} // namespace

void warn_about_solid(const Mesh& mesh, size_t crossing_triangles, Log& log) {
    const MeshHealth health = examine(mesh);
    if (health.boundary_edges > 0) {
        log.warn("the surface is open (" + counted(health.boundary_loops, "hole", "holes") + ", " +
                 counted(health.boundary_edges, "edge", "edges") +
                 "): inside is what it goes around for more than half of all directions");
    }
    // A sheet encloses next to nothing, from either side.
    const double least = 1e-3 * health.area * health.diagonal;
    if (signed_volume(mesh, health.box.centre()) < -least) {
        log.warn("the faces point inwards: the inside is what they enclose all the same");
    }
    if (crossing_triangles > 0) {
        log.warn(counted(crossing_triangles, "triangle passes", "triangles pass") +
                 " through others: what any part encloses is inside");
    }
}

} // namespace anvil
