#include "app/cli/picture_options.h"

#include "engine/core/error.h"

#include <filesystem>

namespace anvil {

PictureSize PictureOptions::size() const {
    return size_text.empty() ? PictureSize() : parse_size(size_text);
}

PictureView PictureOptions::view() const {
    return view_text.empty() ? PictureView() : parse_view(view_text);
}

void check_picture_name(const std::string& path) {
    if (!path.empty() && std::filesystem::path(path).extension() != ".png") {
        throw InputError("--image " + path + ": pictures are PNG files; give a name that ends with .png");
    }
}

void add_picture_options(Command& command, PictureOptions& options) {
    command.option("--image", options.path, "Picture to draw (.png)");
    command.option("--size", options.size_text, "Of the picture, WxH");
    command.option("--view", options.view_text,
                   "Of the picture: front, right, top, or a direction x,y,z to the eye");
}

void write_picture(Device& device, std::span<const PictureSurface> surfaces, const PictureOptions& options) {
    OffscreenRenderer renderer(device);
    write_png(options.path, renderer.render(surfaces, options.view(), options.size()));
}

} // namespace anvil
