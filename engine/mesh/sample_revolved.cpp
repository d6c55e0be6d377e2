#include "engine/mesh/sample_revolved.h"

#include "engine/mesh/triangle_mesh.h"

#include <numbers>
#include <numeric>

namespace anvil::sample {

namespace {

/// Vertices of each ring that is not a pole.
std::vector<uint32_t> share_out(const std::vector<Ring>& rings, size_t vertices) {
    const double wanted = static_cast<double>(vertices) - 2;
    double sum = 0;
    for (const Ring& ring : rings) {
        sum += ring.radius;
    }
    std::vector<double> shares;
    std::vector<uint32_t> counts;
    for (size_t i = 1; i + 1 < rings.size(); ++i) {
        shares.push_back(wanted * rings[i].radius / sum);
        counts.push_back(std::max(3U, static_cast<uint32_t>(std::lround(shares.back()))));
    }
    double total = std::accumulate(counts.begin(), counts.end(), 0.0);
    while (std::abs(total - wanted) > 0.05 * wanted) {
        const double step = total < wanted ? 1 : -1;
        size_t best = counts.size();
        double most = -infinity;
        for (size_t i = 0; i < counts.size(); ++i) {
            const double lack = step * (shares[i] - counts[i]);
            if (lack > most && (step > 0 || counts[i] > 3)) {
                most = lack;
                best = i;
            }
        }
        counts[best] += step > 0 ? 1U : ~0U; // adds or takes one
        total += step;
    }
    return counts;
}

struct PlacedRing {
    uint32_t first = 0;
    uint32_t count = 0;
    double phase = 0; ///< of the first vertex, in edges

    double angle(uint32_t k) const { return (k + phase) / count; } ///< in turns
    uint32_t vertex(uint32_t k) const { return first + k % count; }
};

/// Fills the band between two rings, stepping on the ring whose next vertex comes first.
void zip(const PlacedRing& low, const PlacedRing& high, std::vector<Triangle>& triangles) {
    uint32_t i = 0;
    uint32_t j = 0;
    while (i < low.count || j < high.count) {
        if (j == high.count || (i < low.count && low.angle(i + 1) <= high.angle(j + 1))) {
            triangles.push_back({low.vertex(i), high.vertex(j), low.vertex(i + 1)});
            ++i;
        } else {
            triangles.push_back({low.vertex(i), high.vertex(j), high.vertex(j + 1)});
            ++j;
        }
    }
}

void close_with_pole(const PlacedRing& ring, uint32_t pole, bool upper, std::vector<Triangle>& triangles) {
    for (uint32_t k = 0; k < ring.count; ++k) {
        const uint32_t a = ring.vertex(k);
        const uint32_t b = ring.vertex(k + 1);
        triangles.push_back(upper ? Triangle{a, pole, b} : Triangle{b, pole, a});
    }
}

} // namespace

Mesh revolve(const std::vector<Ring>& rings, size_t vertices) {
    const std::vector<uint32_t> counts = share_out(rings, vertices);
    std::vector<Vec3> positions{{0, rings.front().height, 0}};
    std::vector<PlacedRing> placed;
    for (size_t r = 0; r < counts.size(); ++r) {
        const PlacedRing ring{static_cast<uint32_t>(positions.size()), counts[r], r % 2 == 0 ? 0 : 0.5};
        for (uint32_t k = 0; k < ring.count; ++k) {
            const double angle = 2 * std::numbers::pi * ring.angle(k);
            positions.emplace_back(rings[r + 1].radius * std::cos(angle), rings[r + 1].height,
                                   rings[r + 1].radius * std::sin(angle));
        }
        placed.push_back(ring);
    }
    positions.emplace_back(0, rings.back().height, 0);
    std::vector<Triangle> triangles;
    triangles.reserve(2 * positions.size());
    close_with_pole(placed.front(), 0, false, triangles);
    for (size_t r = 0; r + 1 < placed.size(); ++r) {
        zip(placed[r], placed[r + 1], triangles);
    }
    close_with_pole(placed.back(), static_cast<uint32_t>(positions.size() - 1), true, triangles);
    return mesh_of_triangles(std::move(positions), std::move(triangles));
}

} // namespace anvil::sample
