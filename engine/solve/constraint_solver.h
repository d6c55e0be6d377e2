// The constraint system of an edit: which partial displacements bring all handles to their targets.
#pragma once

#include "engine/core/log.h"

#include <span>
#include <string>
#include <vector>

namespace anvil {

/// Partial displacements and how well they solve the system.
struct Solution {
    size_t handles = 0;                 ///< k
    size_t components = 0;              ///< c: 3 for displacements, 1 for angles
    std::vector<double> x;              ///< k x c, row-major, in the unit of the targets
    size_t rank = 0;                    ///< singular values kept, 0..k
    double condition = 1;               ///< s_max / s_min over all singular values; infinite when rank < k
    std::vector<double> target_error;   ///< k: |A X - D| of each handle's row
    std::vector<double> reach;          ///< k: sum_j |A_ij|; 0 where no weight reaches handle i
    std::vector<double> amplifications; ///< k: sum_j |A_ij X_j| / max |D|; 0 when all targets are 0
    double amplification = 0;           ///< the largest of them
};

/// Partial displacements X (k x c) with A X = D, eq. 4-5 of Bendels & Klein 2003.
/// `weights` is A (k x k, row-major, dimensionless): A(i,j) the weight of handle j at handle i; `targets` is
/// D (k x c, row-major): the total displacement (or angle) of each handle. Singular values below 1e-10 s_max
/// are dropped: coincident handles get the least-norm solution. At full rank each handle lands within
/// 8 eps sum_j |A_ij| |X_j|. Weights or targets scaled by powers of two scale the result bit for bit.
/// @return rank < k and missed targets are results, not errors (see check_targets()).
/// @throws InputError if sizes disagree or an entry is not finite.
Solution solve_constraints(std::span<const double> weights, std::span<const double> targets,
                           size_t components);

/// Judges a solution, `targets` as given to solve_constraints(), `names` one per handle for messages.
/// @throws InputError if a handle misses its target by more than 1e-6 max |D|, unless `least_squares`; it
/// names handle, distance and what would mend it. Warns of an amplification above 1000, naming the handles.
void check_targets(const Solution& solution, std::span<const double> targets, bool least_squares,
                   std::span<const std::string> names, Log& log);

} // namespace anvil
