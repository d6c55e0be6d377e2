// `--image`, `--size` and `--view`, the same for every command that draws.
#pragma once

#include "app/cli/command.h"
#include "engine/gpu/device.h"
#include "engine/gpu/offscreen_renderer.h"
#include "engine/gpu/picture.h"

#include <span>
#include <string>

namespace anvil {

struct PictureOptions {
    std::string path; ///< empty: no picture
    std::string size_text;
    std::string view_text;

    bool wanted() const { return !path.empty(); }
    PictureSize size() const; ///< @throws InputError
    PictureView view() const; ///< @throws InputError
};

/// @throws InputError unless `path` is empty or ends with .png: pictures have that format alone.
void check_picture_name(const std::string& path);

void add_picture_options(Command& command, PictureOptions& options);

/// Draws and writes the PNG file. @throws DeviceError, WriteError
void write_picture(Device& device, std::span<const PictureSurface> surfaces, const PictureOptions& options);

} // namespace anvil
