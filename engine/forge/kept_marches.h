// Distances of an edit that is dragged, kept to go on with.
#pragma once

#include "engine/forge/surface_state.h"

#include <optional>
#include <span>
#include <vector>

namespace anvil {

/// How single fields, one a handle or one an anchor of a smooth blend, were found.
struct MarchWork {
    size_t begun = 0;     ///< from nothing
    size_t continued = 0; ///< from where they had stopped
    size_t extended = 0;  ///< the same with further sources
    size_t steps = 0;     ///< GeodesicMarch::steps() of it all
};

/// Finds distances as SurfaceState does, and keeps the marches over the surface: a larger radius lets them go
/// on where they stopped, and of further sources only what these improve is done again. The numbers are those
/// of SurfaceState; only where approximate fronts meet those of sources that came later they may differ by
/// some tenths of a per cent. Straight distances are found anew. Not for several threads.
class KeptMarches {
  public:
    /// `surface` must outlive this; its mesh and positions stay as they are.
    explicit KeptMarches(SurfaceState& surface) : surface_(surface) {}

    /// One field per query, all at once on all cores; they reach farther than asked where they did before.
    /// What is no longer asked for is dropped, and what would take too much memory is not kept.
    /// @throws InputError as GeodesicSolver::solve does.
    std::vector<DistanceField> distances(std::span<const DistanceQuery> queries);

    const MarchWork& work() const { return work_; }

  private:
    /// A single field: of which query, from what, how far.
    struct Part {
        size_t query;
        DistanceSources sources;
        double reach;
    };
    /// A march, and what it has been asked for.
    struct Kept {
        DistanceMethod method;
        uint32_t rounds;
        DistanceSources sources;
        GeodesicMarch march;
    };

    std::vector<Part> parts_of(std::span<const DistanceQuery> queries) const;
    std::vector<Kept> marches_for(std::span<const DistanceQuery> queries, std::span<const Part> parts,
                                  std::vector<DistanceSources>& further);

    SurfaceState& surface_;
    std::vector<Kept> kept_;
    MarchWork work_;
};

} // namespace anvil
