// What a back end computes an edit from, and where the points end after it.
#pragma once

#include "engine/deform/backend.h"
#include "engine/forge/edit_region.h"

#include <span>
#include <vector>

namespace anvil {

/// Back ends compute relative to the centre of the mesh as it was before any edit.
struct LocalFrame {
    Vec3 origin{0};      ///< world
    double diagonal = 0; ///< of the mesh's bounds
};
LocalFrame local_frame(const Mesh& mesh);

/// The region's points and fields with the occluders. `positions`: of the whole mesh before the edit,
/// world; `origin`: the local origin.
DeformInput deform_input(const EditRegion& region, std::span<const Vec3> positions, const Vec3& origin,
                         OccluderSet occluders);

/// Fills `segments` and `shapes` alone.
void set_shapes(std::span<const ShapeFunction> shapes, DeformInput& input);

/// How far an edit reaches; a hammer on a whole mesh: half of its diagonal.
double largest_radius(const EditRegion& region, double diagonal);

/// Where the n points of an input end, relative to the local origin.
struct EditEnds {
    std::vector<Vec3> displacements; ///< n
    std::vector<Vec3> ends;          ///< n: start + displacement
    std::vector<bool> inside;        ///< n: started inside an occluder
    size_t finished_on_cpu = 0;      ///< moved by finish_contact()
};

/// The back end's displacements in double; where occluders are, the exact finish decides.
/// @throws InternalError naming the point that was moved to no place.
EditEnds finished_ends(const DeformInput& input, std::span<const PointResult> results);

} // namespace anvil
