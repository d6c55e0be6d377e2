#include "app/viewer/scene_picture.h"
#include "engine/gpu/volume_texture.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace anvil;

namespace {

constexpr WindowSize window_size{160, 120};
constexpr uint32_t cells = 180; // of a sheet, along a side: 64,800 triangles
constexpr uint64_t sheet_size = uint64_t{2} * cells * cells;

/// A sheet of hills.
Mesh hills() {
    Mesh mesh;
    for (uint32_t y = 0; y <= cells; ++y) {
        for (uint32_t x = 0; x <= cells; ++x) {
            const double u = 2.0 * x / cells - 1;
            const double v = 2.0 * y / cells - 1;
            mesh.positions.emplace_back(u, v, 0.2 * std::sin(7 * u) * std::cos(5 * v));
        }
    }
    for (uint32_t y = 0; y < cells; ++y) {
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t a = y * (cells + 1) + x;
            mesh.add_polygon(std::array<uint32_t, 4>{a, a + 1, a + cells + 2, a + cells + 1});
        }
    }
    triangulate(mesh);
    return mesh;
}

/// Painting without a window.
class Easel {
  public:
    Easel() : commands_(device_.state()) {}
    ~Easel() { CHECK(device_.take_validation_messages().empty()); }
    Easel(const Easel&) = delete;
    Easel& operator=(const Easel&) = delete;

    DeviceState& state() { return device_.state(); }
    Disposer& disposer() { return disposer_; }

    ScenePicture picture(bool in_parts) { return {state(), vk::Format::eR8G8B8A8Unorm, in_parts, disposer_}; }

    /// One frame, which says that it took this long.
    FrameKind paint(ScenePicture& picture, const Scene& scene, const PictureWish& wish, double milliseconds) {
        const FrameKind kind = picture.prepare(scene, wish);
        const auto& commands = commands_.begin();
        full_barrier(commands);
        picture.record(commands);
        commands_.submit();
        commands_.wait();
        picture.took(milliseconds);
        return kind;
    }

    std::vector<uint8_t> pixels(const ScenePicture& picture) {
        const WindowSize size = picture.size();
        Buffer buffer(state(), uint64_t{4} * size.width * size.height, {}, MemoryUse::download);
        const auto& commands = commands_.begin();
        full_barrier(commands);
        commands.copyImageToBuffer(
            picture.image(), vk::ImageLayout::eTransferSrcOptimal, buffer.handle(),
            vk::BufferImageCopy{
                .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                .imageExtent = {static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height), 1}});
        commands_.submit();
        commands_.wait();
        std::vector<uint8_t> bytes(buffer.size());
        buffer.read(0, std::as_writable_bytes(std::span(bytes)));
        return bytes;
    }

    std::vector<uint8_t> at_once(const Scene& scene, bool fine = false) {
        ScenePicture picture = this->picture(false);
        paint(picture, scene, {window_size, fine}, 1);
        return pixels(picture);
    }

  private:
    Device device_;
    Disposer disposer_;
    Commands commands_;
};

class HillScene {
  public:
    explicit HillScene(Easel& easel)
        : easel_(easel), mesh_(hills()),
          drawn_(std::make_shared<DrawnMesh>(easel.state(), mesh_, mesh_.positions, Vec3(0), true)) {
        for (uint32_t v = 0; v < mesh_.positions.size(); ++v) {
            if (glm::length(mesh_.positions[v] - Vec3(0.3, 0.2, 0)) < 0.35) {
                region_.push_back(v);
            }
        }
        split_ = split_triangles(easel.state(), mesh_, mesh_.positions, region_);
    }

    const SplitTriangles& split() const { return split_; }

    Scene seen_from(double angle) const {
        SceneItem hills;
        hills.mesh = drawn_;
        hills.model_view = glm::translate(glm::mat4(1), glm::vec3(0, 0, -3)) *
                           glm::rotate(glm::mat4(1), static_cast<float>(angle), glm::vec3(1, 0, 0));
        SceneItem glass = hills; // in front of some of it and behind the rest
        glass.colour = glm::vec4(0.2, 0.3, 0.5, 0.4);
        glass.model_view = glm::translate(hills.model_view, glm::vec3(0.2, 0, 0.05));
        Scene scene;
        scene.items = {hills, glass};
        scene.projection = glm::perspectiveRH_ZO(0.8F, 4.0F / 3, 0.5F, 10.0F);
        return scene;
    }

    /// The region raised.
    Scene dragged(double angle, float height) const {
        auto region = std::make_shared<DrawnRegion>();
        region->vertices = region_;
        std::vector<glm::vec3> ends;
        std::vector<glm::vec3> normals;
        std::vector<RegionMark> marks;
        for (const uint32_t v : region_) {
            ends.emplace_back(mesh_.positions[v] + Vec3(0, 0, height));
            normals.emplace_back(0, 0, 1);
            marks.push_back({0.5F, 0.1F});
        }
        region->ends = storage_buffer(easel_.state(), std::span<const glm::vec3>(ends));
        region->normals = storage_buffer(easel_.state(), std::span<const glm::vec3>(normals));
        region->marks = std::make_shared<const Buffer>(
            storage_buffer(easel_.state(), std::span<const RegionMark>(marks)));
        const auto count = static_cast<uint32_t>(region_.size());
        region->surface = {region->ends.handle(), region->normals.handle(), count, count};
        region->inside = split_.inside;
        region->outside = split_.outside;
        Scene scene = seen_from(angle);
        scene.items[0].region = region;
        return scene;
    }

  private:
    Easel& easel_;
    Mesh mesh_;
    std::shared_ptr<DrawnMesh> drawn_;
    std::vector<uint32_t> region_;
    SplitTriangles split_;
};

constexpr double slow = 1000; // milliseconds: the next part is smaller

} // namespace

TEST_CASE(
    "a picture that grows in parts is the one that is drawn at once, and nothing of it is seen before") {
    Easel easel;
    const HillScene hills(easel);
    for (const bool fine : {false, true}) {
        const PictureWish wish{window_size, fine};
        ScenePicture picture = easel.picture(true);
        easel.paint(picture, Scene{}, wish, slow);
        const std::vector<uint8_t> before = easel.pixels(picture);
        size_t frames = 0;
        while (!picture.complete() || frames == 0) {
            CHECK((frames == 0 || easel.pixels(picture) == before));
            easel.paint(picture, hills.seen_from(-0.6), wish, slow);
            ++frames;
            REQUIRE(frames < 100);
        }
        ScenePicture again = easel.picture(true);
        again.prepare(hills.seen_from(-0.6), wish); // nothing was shown before: all at once
        CHECK(again.draws_now() == 3 * sheet_size); // what is translucent counts twice
        CHECK(frames >= 3);
        const std::vector<uint8_t> grown = easel.pixels(picture);
        CHECK(grown != before);
        CHECK(grown == easel.at_once(hills.seen_from(-0.6), fine));
        CHECK(easel.paint(picture, hills.seen_from(-0.6), wish, slow) == FrameKind::panels);
    }
}

TEST_CASE("a step of a drag draws its region alone, and the picture is that of the whole surface") {
    Easel easel;
    const HillScene hills(easel);
    const PictureWish wish{window_size, false, false, true};
    ScenePicture picture = easel.picture(true);
    easel.paint(picture, Scene{}, wish, 1);
    easel.paint(picture, hills.dragged(-0.6, 0), wish, 1);
    for (size_t frames = 0; !picture.complete(); ++frames) {
        REQUIRE(frames < 100);
        easel.paint(picture, hills.dragged(-0.6, 0), wish, 1);
    }
    const uint64_t inside = hills.split().inside->triangle_indices / 3;
    CHECK(inside + hills.split().outside->triangle_indices / 3 == sheet_size);
    CHECK(inside < sheet_size / 5);
    for (const float height : {0.1F, 0.4F, -0.3F}) { // over what stands around it, and under it
        const Scene scene = hills.dragged(-0.6, height);
        picture.prepare(scene, wish);
        CHECK(picture.draws_now() == inside + 2 * sheet_size); // the glass is drawn over it as before
        CHECK(easel.paint(picture, scene, wish, 1) == FrameKind::whole_surface);
        CHECK(easel.pixels(picture) == easel.at_once(scene));
    }
    const Scene turned = hills.dragged(-0.3, 0.4F); // what was kept is of another view
    for (size_t frames = 0; frames == 0 || !picture.complete(); ++frames) {
        REQUIRE(frames < 100);
        easel.paint(picture, turned, wish, 1);
    }
    CHECK(easel.pixels(picture) == easel.at_once(turned));
}

TEST_CASE("scenes that change faster than they are drawn are seen now and then; small ones at once") {
    Easel easel;
    const HillScene hills(easel);
    const PictureWish wish{window_size};
    ScenePicture picture = easel.picture(true);
    easel.paint(picture, Scene{}, wish, slow);
    const std::vector<uint8_t> before = easel.pixels(picture);
    double angle = 0;
    while (easel.pixels(picture) == before) {
        angle -= 0.02;
        REQUIRE(angle > -1);
        easel.paint(picture, hills.seen_from(angle), wish, slow);
    }
    CHECK_FALSE(picture.complete()); // a newer one is wanted
    CHECK(easel.pixels(picture) == easel.at_once(hills.seen_from(-0.02)));
    easel.paint(picture, hills.seen_from(-1), wish, slow); // begins to grow
    CHECK_FALSE(picture.complete());
    CHECK(easel.paint(picture, Scene{}, wish, slow) == FrameKind::whole_surface);
    CHECK(easel.pixels(picture) == before);
    CHECK(easel.paint(picture, hills.seen_from(-1), {window_size, false, true}, slow) ==
          FrameKind::whole_surface); // a file of it is wanted now
}

TEST_CASE("parts become as large as their time allows") {
    PartSize size;
    for (int i = 0; i < 20; ++i) {
        size.took(size.next(), static_cast<double>(size.next()) / 1000); // a thousand a millisecond
    }
    CHECK(static_cast<double>(size.next()) == Approx(1000 * PartSize::wanted_milliseconds).epsilon(0.01));
    const uint64_t before = size.next();
    size.took(100, 1); // a small scene says nothing of large ones
    CHECK(size.next() == before);
    size.took(before, 10 * PartSize::wanted_milliseconds);
    CHECK(size.next() < before / 2);
    for (int i = 0; i < 20; ++i) {
        size.took(size.next(), 1e9);
    }
    CHECK(size.next() > 0); // it goes on
}
