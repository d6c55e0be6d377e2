// From a surface to what the vertex shader reads: view space, normals, packed colours.
#pragma once

#include "engine/gpu/offscreen_renderer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace anvil {

/// Rotation and translation into view space (eye at the origin looking along -z) and the projection.
struct PictureCamera {
    glm::dmat4 view{1};
    glm::mat4 projection{1};
};

/// Frames all finite positions (at least one) as `view` wants it in a picture of width / height = `aspect`.
PictureCamera frame_surfaces(std::span<const PictureSurface> surfaces, const PictureView& view,
                             double aspect);

/// Box of the surface's finite positions.
Box bounds(const PictureSurface& surface);

/// Memory layout of viewer/surface.vert's inputs.
struct SurfaceVertex {
    glm::vec3 position; ///< view space
    glm::vec3 normal;   ///< view space, unit or zero
    float tint;
    std::array<uint8_t, 4> colour; ///< sRGB, alpha unused
};
static_assert(sizeof(SurfaceVertex) == 32);

struct SurfaceGeometry {
    std::vector<SurfaceVertex> vertices;
    std::vector<uint32_t> indices;
};

/// Vertices are split where incident faces meet at more than 50 degrees.
/// @throws InternalError if an index or an attribute's count is wrong.
SurfaceGeometry surface_geometry(const PictureSurface& surface, const glm::dmat4& view);

} // namespace anvil
