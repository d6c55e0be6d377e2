// An occluder as the viewer draws and picks it.
#pragma once

#include "app/viewer/drawn_mesh.h"
#include "app/viewer/orbit_camera.h"
#include "engine/edit/recipe.h"
#include "engine/mesh/search_tree.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace anvil {

/// In its own space, and where it is.
struct OccluderView {
    std::string name;
    std::shared_ptr<DrawnMesh> mesh;        ///< nullptr: not to be drawn
    std::shared_ptr<const SearchTree> tree; ///< of its surface; nullptr: not to be picked
    Vec3 pivot{0};                          ///< what it is turned and scaled about
    Transform transform;
};

/// What an occluder is turned about, in its own space: its origin, or the middle of a file's surface.
Vec3 pivot_of(const OccluderShape& shape, const Box& surface);

/// A point of an occluder's own space in the world.
Vec3 placed_point(const Transform& transform, const Vec3& point);

/// Which occluder the ray meets first; `shown_at`: where each stands.
std::optional<size_t> first_occluder(const Ray& ray, std::span<const OccluderView> occluders,
                                     std::span<const Transform> shown_at);

} // namespace anvil
