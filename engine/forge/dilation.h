// Contact dilation: what an occluder pushes away swells up beside it (section 3, Precise Contact Modelling).
#pragma once

#include "engine/core/progress.h"
#include "engine/deform/deform_input.h"
#include "engine/edit/recipe.h"
#include "engine/forge/edit_region.h"
#include "engine/forge/surface_state.h"
#include "engine/mesh/mesh.h"

#include <optional>
#include <vector>

namespace anvil {

/// What dilation needs of an edit.
struct DilationTask {
    const Mesh& mesh;
    const std::vector<Vec3>& positions; ///< of the whole mesh before the edit, world
    Vec3 origin;                        ///< local origin of `input`
    const EditRegion& region;
    const DeformInput& input; ///< with occluders, none by the paper's rule
    const DeformMotion& motion;
    Dilation dilation;
    double width;                 ///< w: how far from occluder and contact the surface swells
    bool closed;                  ///< the mesh encloses a volume
    Progress* progress = nullptr; ///< hears of the steps and can stop them
};

struct DilationResult {
    std::vector<PointResult> points;     ///< as a back end gives them
    double height = 0;                   ///< what the steps raised at most, summed over them
    std::optional<double> free_volume{}; ///< closed meshes: of the same edit without the occluders
};

/// Runs an edit with dilation, in double and whatever the back end: every step asks for maxima or sums over
/// the contact, for distances along the surface from it and for the volume, before the next can begin. The
/// path is taken in equal steps (as many as `count` says, at most 64; else 32), each with adaptive contact.
/// After each, vertices outside that moved or were moved at go along the mesh's outward normal by rho g(delta
/// / w) (1 - smoothstep(gamma / w)): delta the distance from the occluder, gamma that along the surface (as
/// it was before the edit) from what touched in this step, g(r) = (256/27) r (1 - r)^3. rho: `depth` amount *
/// deepest push of the step; `volume` amount * the volume pushed away over that of a swelling of height 1;
/// solved, such that the volume is that of the edit without occluders. Then contact again.
/// @throws InputError for `solve` on an open mesh, Cancelled.
DilationResult dilate(const DilationTask& task, SurfaceState& surface);

} // namespace anvil
