// How geodesic distances are found.
#pragma once

namespace anvil {

/// `automatic` leaves the choice to the solver.
enum class DistanceMethod { automatic, approximate, exact };

} // namespace anvil
