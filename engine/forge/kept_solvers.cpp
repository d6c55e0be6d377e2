#include "engine/forge/kept_solvers.h"

#include "engine/distance/smoothed_surface.h"

#include <algorithm>
#include <atomic>

namespace anvil {

namespace {

/// Positions smoothed by `rounds`; `store` holds them if they are not the mesh's own.
std::span<const Vec3> smoothed(const Mesh& mesh, std::span<const Vec3> positions, uint32_t rounds,
                               std::vector<Vec3>& store) {
    if (rounds == 0) {
        return positions;
    }
    store = smoothed_positions(mesh, positions, rounds);
    return store;
}

bool is_of_file(const EditedSurface& surface) {
    const std::vector<Vec3>& file = surface.history.first_mesh().positions;
    return surface.history.roots().empty() &&
           std::equal(file.begin(), file.end(), surface.positions.begin(), surface.positions.end());
}

} // namespace

uint64_t new_surface_number() {
    static std::atomic<uint64_t> last{0};
    return ++last;
}

const GeodesicSolver& KeptSolvers::solver(const EditedSurface& surface, uint32_t rounds) {
    std::vector<Vec3> store;
    auto known = kept_.find(rounds);
    if (known == kept_.end()) {
        const Mesh& file = surface.history.first_mesh();
        GeodesicSolver of_file(file, smoothed(file, file.positions, rounds, store));
        known = kept_.emplace(rounds, Kept{std::move(of_file), std::nullopt, 0}).first;
    }
    Kept& kept = known->second;
    if (kept.number != surface.number) {
        kept.number = 0;
        kept.of_surface.reset(); // before the next one takes memory
        if (!is_of_file(surface)) {
            kept.of_surface =
                kept.of_file.updated(surface.mesh, smoothed(surface.mesh, surface.positions, rounds, store),
                                     surface.history.roots());
        }
        kept.number = surface.number;
    }
    return kept.of_surface ? *kept.of_surface : kept.of_file;
}

} // namespace anvil
