#include "engine/mesh/health.h"

namespace anvil {

namespace {

constexpr double huge_coordinate = 1e12;
constexpr double tiny_diagonal = 1e-12;

double largest_coordinate(const Box& box) {
    const Vec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
    return box.empty() ? 0 : std::max({far.x, far.y, far.z});
}

/// "2 isolated vertices (first: vertex 8): what it means".
void warn(Log& log, const Finding& finding, const char* one, const char* many, const char* first_is,
          const char* meaning) {
    if (finding.count == 0) {
        return;
    }
    log.warn(std::to_string(finding.count) + " " + (finding.count == 1 ? one : many) +
             " (first: " + first_is + " " + std::to_string(finding.first) + "): " + meaning);
}

} // namespace

bool far_from_origin(const Box& box) {
    constexpr double half_ulp = 0x1p-25; // at least this fraction of a coordinate is lost in float, at worst
    return largest_coordinate(box) * half_ulp > 1e-4 * box.diagonal() && !box.empty();
}

void warn_about(const MeshHealth& health, Log& log) {
    warn(log, health.isolated_vertices, "isolated vertex", "isolated vertices", "vertex",
         "no face uses them; they stay where they are");
    warn(log, health.bowtie_vertices, "bow-tie vertex", "bow-tie vertices", "vertex",
         "parts of the surface touch only in a point");
    warn(log, health.non_manifold_edges, "non-manifold edge", "non-manifold edges", "at vertex",
         "three or more faces share them");
    warn(log, health.inconsistent_edges, "edge between faces of opposite orientation",
         "edges between faces of opposite orientation", "at vertex", "some faces are flipped");
    warn(log, health.degenerate_triangles, "triangle without area", "triangles without area", "triangle",
         "they have no normal");
    warn(log, health.duplicate_positions, "vertex at the position of another",
         "vertices at the position of others", "vertex", "the surface is not joined there");
    warn(log, health.folded_polygons, "polygon far from planar", "polygons far from planar", "polygon",
         "split into triangles where it folds least");
    if (far_from_origin(health.box)) {
        log.warn(
            "the mesh is far from the origin for its size: single precision would spoil its shape; double "
            "precision is kept");
    }
    if (largest_coordinate(health.box) >= huge_coordinate) {
        log.warn("huge coordinates (1e12 units or more): consider another unit");
    }
    if (health.diagonal > 0 && health.diagonal < tiny_diagonal) {
        log.warn("tiny mesh (its diagonal is below 1e-12 units): consider another unit");
    }
}

} // namespace anvil
