#include "engine/core/error.h"
#include "engine/gpu/offscreen_renderer.h"
#include "tests/gpu/gpu_test.h"

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace anvil;

namespace {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;

    PictureSurface surface() const { return {.positions = positions, .triangles = triangles}; }
};

Shape sphere(glm::vec3 centre, float radius) {
    constexpr uint32_t columns = 96;
    constexpr uint32_t rows = 48;
    Shape shape;
    for (uint32_t j = 0; j <= rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            const float a = 6.2831853F * static_cast<float>(i) / columns;
            const float b = 3.1415927F * static_cast<float>(j) / rows;
            shape.positions.push_back(centre + radius * glm::vec3(std::sin(b) * std::cos(a), std::cos(b),
                                                                  std::sin(b) * std::sin(a)));
        }
    }
    for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            const uint32_t v = j * columns + i;
            const uint32_t w = j * columns + (i + 1) % columns;
            shape.triangles.push_back({v, w, v + columns});
            shape.triangles.push_back({w, w + columns, v + columns});
        }
    }
    return shape;
}

/// A square of half width `half` about `centre`, facing +z.
Shape square(glm::vec3 centre, float half) {
    return {{centre + glm::vec3(-half, -half, 0), centre + glm::vec3(half, -half, 0),
             centre + glm::vec3(half, half, 0), centre + glm::vec3(-half, half, 0)},
            {{0, 1, 2}, {0, 2, 3}}};
}

PictureView flat_view(const char* name) {
    PictureView view = parse_view(name);
    view.orthographic = true;
    return view;
}

glm::ivec3 pixel(const Picture& picture, uint32_t x, uint32_t y) {
    const size_t at = 4 * (size_t{y} * picture.width + x);
    return {picture.rgba.at(at), picture.rgba.at(at + 1), picture.rgba.at(at + 2)};
}

size_t changed_pixels(const Picture& a, const Picture& b) {
    size_t count = 0;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            count += pixel(a, x, y) != pixel(b, x, y) ? 1 : 0;
        }
    }
    return count;
}

} // namespace

TEST_CASE("an empty picture is a light opaque background") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Picture picture = renderer.render({}, {}, {61, 47});
    REQUIRE(picture.rgba.size() == size_t{4} * 61 * 47);
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
        CHECK(picture.rgba[i] >= (i % 4 == 3 ? 255 : 150));
    }
}

TEST_CASE("a sphere's silhouette has the area of its disc") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const PictureSize size{300, 200};
    const Shape ball = sphere({5, -3, 2}, 0.5F);
    const std::array surfaces{ball.surface()};
    const PictureView view = flat_view("front");
    const size_t covered =
        changed_pixels(renderer.render(surfaces, view, size), renderer.render({}, view, size));
    const double radius = 100 * (1 - 2 * view.margin); // in pixels: it fills the height up to the margin
    const double area = 3.14159265 * radius * radius;
    // Pixels that the edge crosses count in full: half of about 8 radius of them. The polygons lose
    // 1 - sin(a) / a of the area, a = 2 pi / 96: 0.07 %; so does a pixel whose shade equals the background's.
    CHECK(static_cast<double>(covered) > area - 0.005 * area);
    CHECK(static_cast<double>(covered) < area + 4 * radius + 0.005 * area);
}

TEST_CASE("the front view has +x to the right and +y up; top and right look along their axes") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    // A frame of tiny balls at the corners of a cube, and one that marks a place.
    const auto marked = [&](glm::vec3 mark, const char* view, uint32_t x, uint32_t y) {
        std::vector<Shape> shapes;
        for (int i = 0; i < 8; ++i) {
            shapes.push_back(
                sphere({(i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1}, 0.01F));
        }
        shapes.push_back(sphere(mark, 0.3F));
        std::vector<PictureSurface> surfaces;
        for (const Shape& shape : shapes) {
            surfaces.push_back(shape.surface());
        }
        const PictureSize size{100, 100};
        const Picture picture = renderer.render(surfaces, flat_view(view), size);
        return pixel(picture, x, y) != pixel(renderer.render({}, flat_view(view), size), x, y);
    };
    CHECK(marked({0.5, 0.5, 0}, "front", 72, 28));
    CHECK_FALSE(marked({0.5, 0.5, 0}, "front", 28, 28));
    CHECK(marked({0, 0.5, 0.5}, "right", 28, 28)); // from +x, +z lies to the left
    CHECK(marked({0.5, 0, 0.5}, "top", 72, 72));   // from above, +z comes down the picture
}

TEST_CASE("a translucent surface blends with what is behind it and hides behind what is in front") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Shape wall = square({0, 0, 0}, 1);
    const auto centre = [&](float z, float opacity) {
        const Shape pane = square({0, 0, z}, 0.5F);
        PictureSurface glass = pane.surface();
        glass.base_colour = {0, 0, 0};
        glass.opacity = opacity;
        const std::array surfaces{glass, wall.surface()};
        return pixel(renderer.render(surfaces, flat_view("front"), {50, 50}), 25, 25);
    };
    const int bare = centre(-0.5F, 0.5F).g; // behind the wall
    const int black = centre(0.5F, 1).g;
    CHECK(centre(-0.5F, 1).g == bare);
    CHECK(centre(0.5F, 0.5F).g < bare - 10);
    CHECK(centre(0.5F, 0.5F).g > black + 10);
    CHECK(centre(0.5F, 0.25F).g > centre(0.5F, 0.75F).g);
}

TEST_CASE("tint runs from the base colour over blue to orange") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Shape wall = square({0, 0, 0}, 1);
    const auto tinted = [&](float tint) {
        const std::vector<float> tints(4, tint);
        PictureSurface surface = wall.surface();
        surface.tint = tints;
        return pixel(renderer.render(std::array{surface}, flat_view("front"), {40, 40}), 20, 20);
    };
    const glm::ivec3 plain =
        pixel(renderer.render(std::array{wall.surface()}, flat_view("front"), {40, 40}), 20, 20);
    CHECK(tinted(0) == plain);
    CHECK(tinted(0.15F).b > tinted(0.15F).r + 40);
    CHECK(tinted(1).r > tinted(1).b + 80);
}

TEST_CASE(
    "lengths darken steadily, with a thin dark line at every multiple of the spacing and nowhere else") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Shape wall = square({0, 0, 0}, 1);
    const std::vector<float> lengths = {0, 2, 2, 0}; // grows by 1 a unit along x
    PictureSurface surface = wall.surface();
    surface.tint = lengths;
    surface.contour_spacing = 0.25F;
    surface.contour_end = 2;
    PictureView view = flat_view("front");
    view.margin = 0;
    const Picture picture = renderer.render(std::array{surface}, view, {400, 400}); // 50 pixels a line
    const auto light = [&](uint32_t x, uint32_t y) {
        const glm::ivec3 p = pixel(picture, x, y);
        return 0.2 * p.r + 0.7 * p.g + 0.1 * p.b; // about as an eye weighs them
    };
    for (const uint32_t y : {100U, 300U}) {
        for (uint32_t x = 12; x < 388; ++x) {
            INFO(x);
            const bool between = x % 50 > 4 && x % 50 < 45; // pixels away from lines
            CHECK((!between || std::abs(light(x + 1, y) - light(x, y)) < 3));
        }
        for (uint32_t x = 25; x + 50 < 400; x += 50) {
            CHECK(light(x + 50, y) < light(x, y) - 3);
        }
        for (uint32_t line = 50; line < 400; line += 50) {
            INFO(line);
            CHECK(std::min(light(line - 1, y), light(line, y)) < light(line - 6, y) - 30);
            CHECK(light(line + 5, y) > light(line - 6, y) - 10);
        }
        CHECK(light(1, y) > light(10, y) - 5); // none at 0
    }
}

TEST_CASE("a perspective picture from any side keeps the whole scene inside its margin") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Shape ball = sphere({0, 0, 0}, 1);
    Shape bar = ball;
    for (glm::vec3& p : bar.positions) {
        p *= glm::vec3(4, 0.5, 0.5);
    }
    for (const char* direction : {"front", "right", "top", "1,1,1", "-3,0.5,-1", "0,-1,0"}) {
        for (const PictureSize size : {PictureSize{120, 60}, PictureSize{60, 120}}) {
            const std::array surfaces{bar.surface()};
            const Picture picture = renderer.render(surfaces, parse_view(direction), size);
            const Picture empty = renderer.render({}, parse_view(direction), size);
            size_t inside = 0;
            size_t border = 0;
            for (uint32_t y = 0; y < size.height; ++y) {
                for (uint32_t x = 0; x < size.width; ++x) {
                    const bool changed = pixel(picture, x, y) != pixel(empty, x, y);
                    const bool edge = x < 2 || y < 2 || x + 2 >= size.width || y + 2 >= size.height;
                    inside += changed ? 1 : 0;
                    border += changed && edge ? 1 : 0;
                }
            }
            INFO(direction << " " << size.width << "x" << size.height);
            CHECK(border == 0);
            CHECK(inside > 100);
        }
    }
}

TEST_CASE("vertices that are not finite are left out; wrong indices are a fault of ours") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    Shape wall = square({0, 0, 0}, 1);
    const Picture whole = renderer.render(std::array{wall.surface()}, flat_view("front"), {40, 40});
    wall.positions.push_back(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    wall.triangles.push_back({0, 1, 4});
    CHECK(renderer.render(std::array{wall.surface()}, flat_view("front"), {40, 40}).rgba == whole.rgba);
    wall.triangles.push_back({0, 1, 5});
    CHECK_THROWS_AS(renderer.render(std::array{wall.surface()}, flat_view("front"), {40, 40}), InternalError);
}

TEST_CASE("one point and a scene without extent are drawn without a fault") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    const Shape point{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}};
    for (const bool orthographic : {false, true}) {
        PictureView view;
        view.orthographic = orthographic;
        CHECK(renderer.render(std::array{point.surface()}, view, {20, 20}).rgba.size() == 1600);
    }
}

TEST_CASE("a picture beyond the device's limits is refused with the limit") {
    const CheckedDevice device;
    OffscreenRenderer renderer(*device);
    CHECK_THROWS_AS(renderer.render({}, {}, {1U << 20, 16}), DeviceError);
    CHECK_THROWS_WITH(renderer.render({}, {}, {1U << 20, 16}), Catch::Contains("--size"));
}

TEST_CASE("views and sizes are read strictly") {
    CHECK(parse_view("front").direction == Vec3(0, 0, 1));
    CHECK(parse_view("1,-2,0.5").direction == Vec3(0.5, -1, 0.25));
    for (const char* bad : {"", "left", "1,2", "1,2,3,4", "0,0,0", "nan,1,1", "1,inf,0", "1,2,x", "1,2,"}) {
        CHECK_THROWS_AS(parse_view(bad), InputError);
    }
    CHECK(parse_size("640x480").width == 640);
    for (const char* bad : {"", "640", "640x", "x480", "0x1", "-4x4", "4.5x4", "640x480x1", "99999x1"}) {
        CHECK_THROWS_AS(parse_size(bad), InputError);
    }
}

TEST_CASE("a picture's file is a PNG of its size; a folder that is missing is said") {
    Picture picture{3, 2, std::vector<uint8_t>(24, 200)};
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "anvil_picture_test";
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / "picture.png";
    write_png(path.string(), picture);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    REQUIRE(bytes.size() > 24);
    CHECK(bytes.substr(1, 3) == "PNG");
    CHECK((bytes[19] == 3 && bytes[23] == 2)); // width and height of the header chunk
    CHECK_THROWS_AS(write_png((folder / "none" / "picture.png").string(), picture), WriteError);
    std::filesystem::remove_all(folder);
}
