// How far adaptive steps end from where small ones do.
#pragma once

#include "app/bench/bench_case.h"
#include "app/bench/deform_scene.h"
#include "engine/deform/backend.h"

namespace anvil {

/// Of the scene's motion on a back end, against the double reference in `converged_steps` equal ones; over
/// some thousands of the points. `diagonal`: of the whole mesh.
StepError step_error(Backend& tested, Backend& reference, const DeformScene& scene, double diagonal);

inline constexpr uint32_t converged_steps = 8192;

} // namespace anvil
