// Geodesic solvers that serve a mesh through its edits.
#pragma once

#include "engine/distance/distance.h"
#include "engine/refine/refined_places.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>

namespace anvil {

/// A number that no other surface (a mesh at certain positions) of this process has.
uint64_t new_surface_number();

/// A surface that edits have left, as solvers need to know it.
struct EditedSurface {
    const Mesh& mesh;
    std::span<const Vec3> positions;
    const RefinementHistory& history; ///< of the mesh
    uint64_t number;                  ///< the same for no other surface
};

/// For each amount of smoothing a solver of the file's own mesh, made when first asked for and then kept, and
/// what it becomes when brought up to date with the surface asked for last: an edit costs the work of the
/// part by which the surface differs from the file's. Distances so depend on that surface alone, bit for bit,
/// and not on those asked for before: an edit that is undone and done again, or replayed from a recipe, gives
/// the same. For one file; not for several threads.
class KeptSolvers {
  public:
    /// Distances on the surface, smoothed by `rounds`. Holds until another surface is asked for.
    const GeodesicSolver& solver(const EditedSurface& surface, uint32_t rounds);

  private:
    struct Kept {
        GeodesicSolver of_file;
        std::optional<GeodesicSolver> of_surface; ///< empty: it is the file's
        uint64_t number;                          ///< of the surface
    };
    std::map<uint32_t, Kept> kept_; ///< by rounds of smoothing
};

} // namespace anvil
