// What touches the occluders after an edit, in the numbers of the mesh.
#pragma once

#include "engine/forge/edit_input.h"
#include "engine/forge/report.h"
#include "engine/mesh/mesh.h"

#include <span>
#include <vector>

namespace anvil {

/// Counts of the edit's contact; its points are those of the region, its triangles those of the mesh.
/// `positions`: of the whole mesh after the edit, world; `origin`: the local origin.
ContactReport contact_of(const DeformInput& input, const EditEnds& ends, const EditRegion& region,
                         const Mesh& mesh, std::span<const Vec3> positions, const Vec3& origin);

/// The same by vertices and by faces with their triangles, one list for each of the occluders' `names`.
std::vector<ContactList> contact_lists(const ContactReport& contact, const std::vector<std::string>& names,
                                       const EditRegion& region, const Mesh& mesh);

} // namespace anvil
