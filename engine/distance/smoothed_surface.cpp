#include "engine/distance/smoothed_surface.h"

#include "engine/core/parallel_for.h"

namespace anvil {
namespace {

/// The neighbours of each vertex that may move; none for the others.
struct Neighbours {
    std::vector<uint32_t> begin;
    std::vector<uint32_t> vertices;

    std::span<const uint32_t> of(size_t v) const {
        return {vertices.data() + begin[v], vertices.data() + begin[v + 1]};
    }
};

/// Both ends of every triangle's sides, grouped by vertex: inner edges are listed twice.
Neighbours side_ends(std::span<const Triangle> triangles, size_t vertex_count) {
    Neighbours ends{std::vector<uint32_t>(vertex_count + 2, 0), std::vector<uint32_t>(6 * triangles.size())};
    for (const Triangle& t : triangles) {
        for (const uint32_t v : t) {
            ends.begin[v + 2] += 2;
        }
    }
    for (size_t v = 2; v < ends.begin.size(); ++v) {
        ends.begin[v] += ends.begin[v - 1];
    }
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            ends.vertices[ends.begin[t[k] + 1]++] = t[(k + 1) % 3];
            ends.vertices[ends.begin[t[k] + 1]++] = t[(k + 2) % 3];
        }
    }
    ends.begin.pop_back();
    return ends;
}

Neighbours find_neighbours(const Mesh& mesh) {
    Neighbours ends = side_ends(mesh.triangles, mesh.vertex_count());
    Neighbours result{{0}, {}};
    result.begin.reserve(mesh.vertex_count() + 1);
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto first = ends.vertices.begin() + ends.begin[v],
                   last = ends.vertices.begin() + ends.begin[v + 1];
        std::sort(first, last);
        const size_t before = result.vertices.size();
        bool inner = true;
        for (auto at = first; at != last;) {
            const auto next = std::find_if(at, last, [&](uint32_t w) { return w != *at; });
            inner = inner && next - at == 2 && *at != v;
            result.vertices.push_back(*at);
            at = next;
        }
        if (!inner) {
            result.vertices.resize(before);
        }
        result.begin.push_back(static_cast<uint32_t>(result.vertices.size()));
    }
    return result;
}

/// Weights of the Chebyshev polynomials 0 to `degree` of the averaging that pass low frequencies; they sum to
/// 1.
std::vector<double> low_pass_weights(uint32_t degree) {
    // A damped step falls over some pi / terms; this far from 0 what is large is kept within 2 %.
    const double terms = degree + 1.0;
    const double cut = std::min(3 * M_PI / terms, 0.5 * M_PI);
    const double turn = M_PI / (terms + 1);
    std::vector<double> weights;
    double sum = 0;
    for (uint32_t j = 0; j <= degree; ++j) {
        const double damping =
            ((terms - j + 1) * std::cos(turn * j) + std::sin(turn * j) / std::tan(turn)) / (terms + 1);
        weights.push_back(damping * (j == 0 ? cut / M_PI : 2 * std::sin(j * cut) / (j * M_PI)));
        sum += weights.back();
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

/// Tells `body` each vertex with its neighbours' mean; vertices without neighbours are their own mean.
template <typename Body>
void for_each_mean(const Neighbours& neighbours, const std::vector<Vec3>& values, const Body& body) {
    parallel_for(values.size(), 1 << 12, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            Vec3 sum(0);
            for (const uint32_t w : neighbours.of(v)) {
                sum += values[w];
            }
            const size_t count = neighbours.of(v).size();
            body(v, count > 0 ? sum / static_cast<double>(count) : values[v]);
        }
    });
}

std::vector<Vec3> low_passed(const Neighbours& neighbours, std::span<const Vec3> positions, uint32_t rounds) {
    const std::vector<double> weights = low_pass_weights(rounds);
    std::vector<Vec3> before(positions.begin(), positions.end()), here(before.size()), result(before.size());
    for_each_mean(neighbours, before, [&](size_t v, const Vec3& mean) {
        here[v] = mean;
        result[v] = weights[0] * before[v] + weights[1] * mean;
    });
    for (uint32_t j = 2; j <= rounds; ++j) {
        // T_j = 2 W T_(j-1) - T_(j-2), in place of the latter.
        for_each_mean(neighbours, here, [&](size_t v, const Vec3& mean) {
            before[v] = 2.0 * mean - before[v];
            result[v] += weights[j] * before[v];
        });
        std::swap(before, here);
    }
    return result;
}

} // namespace

std::vector<Vec3> smoothed_positions(const Mesh& mesh, std::span<const Vec3> positions, uint32_t rounds) {
    std::vector<Vec3> result(positions.begin(), positions.end());
    if (rounds == 0) {
        return result;
    }
    const Neighbours neighbours = find_neighbours(mesh);
    const std::vector<Vec3> smooth = low_passed(neighbours, positions, rounds);
    const std::vector<Vec3> normals = vertex_normals(mesh, smooth);
    for (size_t v = 0; v < result.size(); ++v) {
        if (!neighbours.of(v).empty()) {
            result[v] += glm::dot(normals[v], smooth[v] - result[v]) * normals[v];
        }
    }
    return result;
}

} // namespace anvil
