#include "app/cli/picture_options.h"

#include <CLI/CLI.hpp>

namespace anvil {

PictureSize PictureOptions::size() const {
    return size_text.empty() ? PictureSize() : parse_size(size_text);
}

PictureView PictureOptions::view() const {
    return view_text.empty() ? PictureView() : parse_view(view_text);
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
    const PictureSize size;
    CLI::Option* image = command.add_option("--image", options.path, "Picture to draw (.png)");
    command
        .add_option("--size", options.size_text,
                    "Size of the picture, WxH [" + std::to_string(size.width) + "x" +
                        std::to_string(size.height) + "]")
        ->needs(image);
    command.add_option("--view", options.view_text, "Where from: front, right, top or x,y,z")->needs(image);
}

void write_picture(Device& device, std::span<const PictureSurface> surfaces, const PictureOptions& options) {
    OffscreenRenderer renderer(device);
    write_png(options.path, renderer.render(surfaces, options.view(), options.size()));
}

} // namespace anvil
