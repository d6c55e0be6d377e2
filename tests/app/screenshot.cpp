#include "tests/app/screenshot.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <stb_image.h>

namespace anvil {

int Screenshot::off(int x, int y, int red, int green, int blue) const {
    const size_t at = 3 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    return std::max(
        {std::abs(rgb.at(at) - red), std::abs(rgb.at(at + 1) - green), std::abs(rgb.at(at + 2) - blue)});
}

size_t Screenshot::count(int red, int green, int blue, int most) const {
    size_t found = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            found += off(x, y, red, green, blue) <= most ? 1 : 0;
        }
    }
    return found;
}

Screenshot read_screenshot(const std::string& file) {
    Screenshot picture;
    int channels = 0;
    uint8_t* pixels = stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3);
    INFO(file);
    REQUIRE(pixels != nullptr);
    picture.rgb.assign(pixels, pixels + size_t{3} * static_cast<size_t>(picture.width) *
                                            static_cast<size_t>(picture.height));
    stbi_image_free(pixels);
    return picture;
}

std::vector<size_t> changed_by_column(const Screenshot& a, const Screenshot& b, int rows, int least) {
    REQUIRE((a.width == b.width && a.height == b.height && rows <= a.height));
    std::vector<size_t> changed(static_cast<size_t>(a.width), 0);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const size_t at =
                3 * (static_cast<size_t>(y) * static_cast<size_t>(a.width) + static_cast<size_t>(x));
            changed[static_cast<size_t>(x)] +=
                a.off(x, y, b.rgb[at], b.rgb[at + 1], b.rgb[at + 2]) > least ? 1 : 0;
        }
    }
    return changed;
}

} // namespace anvil
