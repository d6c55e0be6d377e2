// Draws shaded surfaces into a picture without a window.
#pragma once

#include "engine/core/types.h"
#include "engine/gpu/device.h"
#include "engine/gpu/picture.h"

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace anvil {

/// Triangles to draw. Positions are relative to one local origin that all surfaces of a picture share.
/// Normals are area-weighted and break where faces meet at more than 50 degrees. Both sides of a triangle
/// show.
struct PictureSurface {
    std::span<const glm::vec3> positions;
    std::span<const Triangle> triangles;     ///< indices < positions.size()
    std::span<const float> tint = {};        ///< a vertex: 0 (base colour) .. blue .. 1 (orange); empty: none
    std::span<const glm::vec3> colours = {}; ///< a vertex, sRGB 0..1, in place of base_colour; empty: none
    glm::vec3 base_colour{0.835F, 0.745F, 0.665F}; ///< sRGB 0..1
    /// > 0: `tint` holds lengths, coloured from yellow (0) to blue (contour_end) in place of all else, with a
    /// line at every multiple of the spacing.
    float contour_spacing = 0;
    float contour_end = 1;
    float opacity = 1; ///< < 1: drawn after the opaque ones, farthest first, back faces first
};

class OffscreenRenderer {
  public:
    /// @throws DeviceError if the device cannot draw.
    explicit OffscreenRenderer(Device& device);
    ~OffscreenRenderer();
    OffscreenRenderer(OffscreenRenderer&&) noexcept;

    /// Four samples a pixel; light background. Nothing to draw: the background alone. Vertices that are not
    /// finite and the triangles at them are left out.
    /// @throws DeviceError if the size exceeds the device's limits or memory is out; InternalError if an
    /// index or an attribute's count is wrong.
    Picture render(std::span<const PictureSurface> surfaces, const PictureView& view, PictureSize size);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace anvil
