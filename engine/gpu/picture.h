// A picture in memory, where it is looked at from, and its PNG file.
#pragma once

#include "engine/core/types.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anvil {

/// Rows from top to bottom, four bytes a pixel: red, green, blue (sRGB), alpha (255).
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

/// Where the eye is: `direction` points from the scene to the eye (any length > 0); y is up (towards the top
/// of a picture from above: -z). The scene's box fills the picture up to `margin`, a fraction of the
/// picture's side.
struct PictureView {
    Vec3 direction{0.35, 0.25, 1.0};
    bool orthographic = false;
    double margin = 0.06;
};

/// `front` (eye at +z), `right` (+x), `top` (+y) or `x,y,z`. @throws InputError on anything else.
PictureView parse_view(std::string_view text);

struct PictureSize {
    uint32_t width = 1280;
    uint32_t height = 960;
};

/// `WxH`, each 1..16384. @throws InputError on anything else.
PictureSize parse_size(std::string_view text);

/// Writes a PNG file, whole or not at all. @throws WriteError
void write_png(const std::string& path, const Picture& picture);

} // namespace anvil
