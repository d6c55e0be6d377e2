#include "engine/mesh/health.h"

#include "engine/mesh/edge_list.h"
#include "engine/mesh/scale.h"
#include "engine/mesh/weld.h"

#include <numbers>
#include <numeric>

namespace anvil {

namespace {

constexpr double needle_degrees = 5;
constexpr double degenerate_height = 1e-10;
constexpr double nonplanar = 1e-3;
constexpr double folded = 0.1;

class UnionFind {
  public:
    explicit UnionFind(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    uint32_t root(uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void join(uint32_t a, uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<uint32_t> parent_;
};

/// Counts edges by kind and joins the corners that meet across an edge: what is left apart at a vertex are
/// its fans.
void examine_edges(const Mesh& mesh, const EdgeList& list, UnionFind& fans, MeshHealth& health) {
    health.closed = mesh.polygon_count() > 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        for (size_t i = list.begin[v]; i < list.begin[v + 1];) {
            const EdgeUse& first = list.uses[i];
            size_t count = 0;
            size_t forward = 0;
            for (; i < list.begin[v + 1] && list.uses[i].high == first.high; ++i, ++count) {
                forward += list.uses[i].forward ? 1 : 0;
                fans.join(first.low_corner, list.uses[i].low_corner);
                fans.join(first.high_corner, list.uses[i].high_corner);
            }
            ++health.edges;
            health.boundary_edges += count == 1 ? 1 : 0;
            health.closed = health.closed && 2 * forward == count;
            if (count > 2) {
                health.non_manifold_edges.add(v);
            } else if (count == 2 && forward != 1) {
                health.inconsistent_edges.add(v);
            }
        }
    }
}

void join_repeated_corners(const Mesh& mesh, UnionFind& fans) {
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        for (uint32_t c = mesh.polygon_begin[f]; c + 1 < mesh.polygon_begin[f + 1]; ++c) {
            if (mesh.corners[c] == mesh.corners[c + 1]) {
                fans.join(c, c + 1);
            }
        }
        const uint32_t first = mesh.polygon_begin[f];
        const uint32_t last = mesh.polygon_begin[f + 1] - 1;
        if (mesh.corners[first] == mesh.corners[last]) {
            fans.join(first, last);
        }
    }
}

void count_boundary_loops(const EdgeList& list, MeshHealth& health) {
    UnionFind loops(list.begin.size());
    std::vector<bool> on_boundary(list.begin.size(), false);
    for (uint32_t v = 0; v + 1 < list.begin.size(); ++v) {
        for (size_t i = list.begin[v]; i < list.begin[v + 1]; ++i) {
            const bool alone = (i == list.begin[v] || list.uses[i - 1].high != list.uses[i].high) &&
                               (i + 1 == list.begin[v + 1] || list.uses[i + 1].high != list.uses[i].high);
            if (alone) {
                loops.join(v, list.uses[i].high);
                on_boundary[v] = true;
                on_boundary[list.uses[i].high] = true;
            }
        }
    }
    for (uint32_t v = 0; v < on_boundary.size(); ++v) {
        health.boundary_loops += on_boundary[v] && loops.root(v) == v ? 1 : 0;
    }
}

void examine_vertices(const Mesh& mesh, UnionFind& fans, MeshHealth& health) {
    std::vector<uint32_t> fan_of(mesh.vertex_count(), no_index);
    std::vector<bool> bowtie(mesh.vertex_count(), false);
    for (uint32_t c = 0; c < mesh.corners.size(); ++c) {
        const uint32_t fan = fans.root(c);
        uint32_t& known = fan_of[mesh.corners[c]];
        known = known == no_index ? fan : known;
        if (known != fan) {
            bowtie[mesh.corners[c]] = true;
        }
    }
    const std::vector<uint32_t> first = first_equal(mesh.positions);
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (fan_of[v] == no_index) {
            health.isolated_vertices.add(v);
        }
        if (bowtie[v]) {
            health.bowtie_vertices.add(v);
        }
        if (first[v] != v) {
            health.duplicate_positions.add(v);
        }
    }
}

void count_components(const Mesh& mesh, MeshHealth& health) {
    UnionFind parts(mesh.vertex_count());
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        for (const uint32_t v : mesh.polygon(f)) {
            parts.join(mesh.polygon(f).front(), v);
        }
    }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        health.components += parts.root(v) == v ? 1 : 0;
    }
    health.components -= health.isolated_vertices.count;
}

/// Cotangent of the smallest angle (the larger, the thinner), or -1 for a degenerate triangle.
double largest_cotangent(const Vec3& a, Vec3 b, Vec3 c) {
    const Vec3 extent = glm::abs(b - a) + glm::abs(c - a);
    const double scale = unit_scale(extent.x + extent.y + extent.z);
    b = scale * (b - a);
    c = scale * (c - a);
    std::array<double, 3> squared = {glm::dot(b, b), glm::dot(c - b, c - b), glm::dot(c, c)};
    const Vec3 normal = glm::cross(b, c);
    const double doubled_area = glm::length(normal);
    std::sort(squared.begin(), squared.end());
    if (!(doubled_area > degenerate_height * squared[2])) {
        return -1;
    }
    return (squared[1] + squared[2] - squared[0]) / (2 * doubled_area);
}

void examine_triangles(const Mesh& mesh, MeshHealth& health) {
    // An isolated vertex may be so far away that its box's centre would cost the triangles their digits.
    Box used;
    for (const uint32_t v : mesh.corners) {
        used.include(mesh.positions[v]);
    }
    const double scale = unit_scale(used.diagonal());
    const Vec3 centre = used.centre();
    double area = 0;
    double volume = 0;
    const double needle = 1 / std::tan(needle_degrees * std::numbers::pi / 180);
    double thinnest = 0;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const Vec3 a = scale * (mesh.positions[t[0]] - centre);
        const Vec3 b = scale * (mesh.positions[t[1]] - centre);
        const Vec3 c = scale * (mesh.positions[t[2]] - centre);
        const Vec3 normal = glm::cross(b - a, c - a);
        area += 0.5 * glm::length(normal);
        volume += glm::dot(a, normal) / 6;
        const double cotangent =
            largest_cotangent(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        if (cotangent < 0) {
            health.degenerate_triangles.add(i);
            continue;
        }
        thinnest = std::max(thinnest, cotangent);
        health.needles += cotangent > needle ? 1 : 0;
    }
    if (health.degenerate_triangles.count < mesh.triangles.size()) {
        health.min_angle = std::atan2(1, thinnest) * 180 / std::numbers::pi;
    }
    health.area = area / scale / scale;
    if (health.closed) {
        health.volume = volume / scale / scale / scale;
    }
}

/// Largest distance of a corner from the mean plane, over the largest from the mean corner.
double warp(const Mesh& mesh, std::span<const uint32_t> polygon) {
    const Vec3 origin = mesh.positions[polygon[0]];
    Vec3 mean{0};
    double longest = 0;
    for (const uint32_t v : polygon) {
        const Vec3 p = mesh.positions[v] - origin;
        longest = std::max({longest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const double scale = unit_scale(longest);
    for (const uint32_t v : polygon) {
        mean += scale * (mesh.positions[v] - origin) / static_cast<double>(polygon.size());
    }
    Vec3 normal{0};
    Vec3 previous = scale * (mesh.positions[polygon.back()] - origin) - mean;
    double size = 0;
    for (const uint32_t v : polygon) {
        const Vec3 p = scale * (mesh.positions[v] - origin) - mean;
        normal += glm::cross(previous, p);
        size = std::max(size, glm::length(p));
        previous = p;
    }
    const double length = glm::length(normal);
    if (!(length > degenerate_height * size * size)) {
        return 0;
    }
    double distance = 0;
    for (const uint32_t v : polygon) {
        const Vec3 p = scale * (mesh.positions[v] - origin) - mean;
        distance = std::max(distance, std::abs(glm::dot(p, normal)) / length);
    }
    return distance / size;
}

void examine_polygons(const Mesh& mesh, MeshHealth& health) {
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        if (mesh.polygon(f).size() == 3) {
            continue;
        }
        const double deviation = warp(mesh, mesh.polygon(f));
        if (deviation > nonplanar) {
            health.nonplanar_polygons.add(f);
        }
        if (deviation > folded) {
            health.folded_polygons.add(f);
        }
    }
}

} // namespace

MeshHealth examine(const Mesh& mesh) {
    MeshHealth health;
    health.vertices = mesh.vertex_count();
    health.polygons = mesh.polygon_count();
    health.triangles = mesh.triangles.size();
    health.box = bounds(mesh);
    health.diagonal = health.box.diagonal();
    const EdgeList edges = list_edges(mesh);
    UnionFind fans(mesh.corners.size());
    join_repeated_corners(mesh, fans);
    examine_edges(mesh, edges, fans, health);
    count_boundary_loops(edges, health);
    examine_vertices(mesh, fans, health);
    count_components(mesh, health);
    examine_triangles(mesh, health);
    examine_polygons(mesh, health);
    health.euler_number = static_cast<long long>(health.vertices - health.isolated_vertices.count) -
                          static_cast<long long>(health.edges) + static_cast<long long>(health.polygons);
    return health;
}

} // namespace anvil
