#include "engine/gpu/picture.h"

#include "engine/core/error.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace anvil {

namespace {

constexpr uint32_t longest_side = 16384;

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
    Number value{};
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || stop != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

std::optional<Vec3> parse_direction(std::string_view text) {
    Vec3 direction{0};
    for (int axis = 0; axis < 3; ++axis) {
        const size_t comma = axis < 2 ? text.find(',') : text.size();
        if (comma == std::string_view::npos) {
            return std::nullopt;
        }
        const std::optional<double> value = parse_number<double>(text.substr(0, comma));
        if (!value) {
            return std::nullopt;
        }
        direction[axis] = *value;
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (!text.empty() || !is_finite(direction) || largest == 0) {
        return std::nullopt;
    }
    return direction / largest;
}

} // namespace

PictureView parse_view(std::string_view text) {
    PictureView view;
    if (text == "front") {
        view.direction = {0, 0, 1};
    } else if (text == "right") {
        view.direction = {1, 0, 0};
    } else if (text == "top") {
        view.direction = {0, 1, 0};
    } else if (const std::optional<Vec3> direction = parse_direction(text)) {
        view.direction = *direction;
    } else {
        throw InputError("--view \"" + std::string(text) +
                         "\": wanted is front, right, top or a direction x,y,z that is not zero");
    }
    return view;
}

PictureSize parse_size(std::string_view text) {
    const size_t cross = text.find('x');
    if (cross != std::string_view::npos) {
        const auto width = parse_number<uint32_t>(text.substr(0, cross));
        const auto height = parse_number<uint32_t>(text.substr(cross + 1));
        if (width && height && *width >= 1 && *height >= 1 && *width <= longest_side &&
            *height <= longest_side) {
            return {*width, *height};
        }
    }
    throw InputError("--size \"" + std::string(text) + "\": wanted is WxH, each between 1 and " +
                     std::to_string(longest_side) + ", e.g. 1280x960");
}

} // namespace anvil
