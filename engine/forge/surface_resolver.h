// From a recipe's addresses to points of the mesh as it stands.
#pragma once

#include "engine/edit/surface_address.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/search_tree.h"
#include "engine/mesh/surface_point.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace anvil {

/// Finds surface points of one mesh at one set of positions, which must outlive it; the search tree is built
/// when the first `nearest` asks for it.
class SurfaceResolver {
  public:
    SurfaceResolver(const Mesh& mesh, std::span<const Vec3> positions) : mesh_(mesh), positions_(positions) {}

    /// `place` begins the message, e.g. "edits[0].handles[1].at".
    /// @throws InputError if an index is out of range or the mesh has no surface to be near to.
    SurfacePoint resolve(const SurfaceAddress& address, const std::string& place);

    Vec3 position_of(const SurfacePoint& point) const;
    /// The vertices that carry the point, weights > 0.
    std::vector<VertexWeight> weights_of(const SurfacePoint& point) const;

  private:
    SurfacePoint at_vertex(uint32_t vertex, const std::string& place);
    SurfacePoint at_face(const FaceAddress& address, const std::string& place) const;
    SurfacePoint near(const Vec3& point, const std::string& place);

    const Mesh& mesh_;
    std::span<const Vec3> positions_;
    std::unique_ptr<SearchTree> tree_;
};

} // namespace anvil
