#include "engine/forge/kept_solvers.h"

#include "engine/distance/smoothed_surface.h"

namespace anvil {

const GeodesicSolver& KeptSolvers::solver(const Mesh& mesh, std::span<const Vec3> positions,
                                          uint32_t rounds) {
    const auto known = kept_.find(rounds);
    if (known != kept_.end() && known->second.is_current) {
        return known->second.solver;
    }
    const std::vector<Vec3> smoothed =
        rounds > 0 ? smoothed_positions(mesh, positions, rounds) : std::vector<Vec3>{};
    const std::span<const Vec3> places = rounds > 0 ? std::span<const Vec3>(smoothed) : positions;
    if (known == kept_.end()) {
        return kept_.emplace(rounds, Kept{GeodesicSolver(mesh, places), {}}).first->second.solver;
    }
    known->second.solver.update(mesh, places, known->second.roots);
    known->second.roots.clear();
    known->second.is_current = true;
    return known->second.solver;
}

void KeptSolvers::moved() {
    for (auto& [rounds, kept] : kept_) {
        kept.is_current = false;
    }
}

void KeptSolvers::divided(std::span<const uint32_t> roots) {
    for (auto& [rounds, kept] : kept_) {
        std::vector<uint32_t> first(roots.begin(), roots.end());
        for (uint32_t& root : first) {
            root = kept.roots.empty() ? root : kept.roots[root];
        }
        kept.roots = std::move(first);
        kept.is_current = false;
    }
}

} // namespace anvil
