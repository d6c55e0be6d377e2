// The edits that `anvil bench` times, at any size: an icosphere whose pole is pushed or turned into an
// occluder.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/mesh/mesh.h"

#include <memory>
#include <optional>

namespace anvil {

/// How the points of a scene follow each other: as those of an edit's region do, as the mesh's vertices, or
/// at random.
enum class PointOrder { by_place, as_given, shuffled };

struct DeformSceneOptions {
    size_t handles = 1;
    double share = 1; ///< of the sphere's vertices that lie within the radius; 1 handle
    const OccluderModel* occluder = nullptr; ///< of about unit size; nullptr: none
    uint32_t fixed_steps = 0;                ///< 0: adaptive
    MotionKind kind = MotionKind::straight;
    PointOrder order = PointOrder::by_place;
    bool normals = false; ///< of the points and those around them
};

struct DeformScene {
    std::shared_ptr<DeformInput> input;
    DeformMotion motion;
};

/// `sphere`: radius 1 at the origin.
DeformScene make_deform_scene(const Mesh& sphere, const DeformSceneOptions& options);

/// What a kernel has to read and write at least once for this scene, as floats.
uint64_t state_bytes(const DeformScene& scene);

} // namespace anvil
