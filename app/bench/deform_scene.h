// The edits that `anvil bench` times, at any size: an icosphere whose pole is pushed or turned into an
// occluder.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/mesh/mesh.h"

#include <memory>
#include <optional>

namespace anvil {

struct DeformSceneOptions {
    size_t handles = 1;
    double share = 1; ///< of the sphere's vertices that lie within the radius; 1 handle
    const OccluderModel* occluder = nullptr; ///< of about unit size; nullptr: none
    uint32_t fixed_steps = 0;                ///< 0: adaptive
    MotionKind kind = MotionKind::straight;
    bool shuffled = false; ///< points in random order in place of the mesh's
};

struct DeformScene {
    DeformInput input;
    DeformMotion motion;
};

/// `sphere`: radius 1 at the origin.
DeformScene make_deform_scene(const Mesh& sphere, const DeformSceneOptions& options);

/// What a kernel has to read and write at least once for this scene, as floats.
uint64_t state_bytes(const DeformScene& scene);

} // namespace anvil
