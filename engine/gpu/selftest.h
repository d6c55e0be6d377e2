// Any back end against the double reference, over cases described once: `anvil selftest` and the parity
// tests.
#pragma once

#include "engine/deform/backend.h"

#include <string>
#include <vector>

namespace anvil {

/// One edit of random points, the same on every machine.
struct SelftestCase {
    std::string name;
    DeformInput input;
    DeformMotion motion;
    double diagonal = 1;  ///< of the points and their path
    double lipschitz = 1; ///< of the shape functions, at least 1
};

/// Everything the kernel can do: numbers of handles, motions, shapes, influences, steps, sampled fields,
/// several occluders, odd and tiny counts.
std::vector<SelftestCase> selftest_cases();

struct SelftestResult {
    std::string name;
    size_t points = 0;
    size_t non_finite = 0;  ///< counted first; must be 0
    size_t deviating = 0;   ///< beyond `allowed` and not bifurcating; must be 0
    size_t bifurcating = 0; ///< the reference itself jumps there; at most 0.1 % (3 in small cases)
    size_t penetrating = 0; ///< bifurcating ones that ended inside an occluder; must be 0
    double worst = 0;       ///< largest |difference| / diagonal, bifurcating points excluded
    double allowed = 0;     ///< 5e-6 max(1, Lip phi): mathematics section 4, Truth

    bool passed() const;
};

/// Runs one case on both. A point beyond the allowed deviation is bifurcating if the reference's result moves
/// by more than 1e-4 of the diagonal when its input moves by 4 float ulps.
SelftestResult run_selftest_case(Backend& backend, const SelftestCase& test);

/// Bakes a field of a damaged mesh with the device and without: `points` are its samples, `deviating` those
/// whose distance differs, `bifurcating` those whose normal alone does (of triangles equally near).
/// @throws DeviceError
SelftestResult run_baking_selftest(SearchDevice& device);

} // namespace anvil
