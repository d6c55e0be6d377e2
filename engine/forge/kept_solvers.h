// Geodesic solvers that follow a mesh through its edits.
#pragma once

#include "engine/distance/distance.h"

#include <map>
#include <span>
#include <vector>

namespace anvil {

/// One solver per amount of smoothing, made when first asked for. Edits that change a part of the mesh cost
/// its next solver the work of that part. Not for several threads.
class KeptSolvers {
  public:
    /// Distances on `mesh` at `positions`, smoothed by `rounds`. These are the same as before unless one of
    /// the calls below said otherwise.
    const GeodesicSolver& solver(const Mesh& mesh, std::span<const Vec3> positions, uint32_t rounds);

    /// The mesh has other positions now.
    void moved();
    /// The mesh is another now: `roots` has, per triangle, the one before that it is part of. Vertices keep
    /// their numbers, new ones follow.
    void divided(std::span<const uint32_t> roots);

  private:
    struct Kept {
        GeodesicSolver solver;
        std::vector<uint32_t> roots; ///< per triangle now: that of the solver's mesh; empty: itself
        bool is_current = true;
    };
    std::map<uint32_t, Kept> kept_; ///< by rounds of smoothing
};

} // namespace anvil
