#include "app/viewer/scene_picture.h"

#include <algorithm>
#include <array>
#include <utility>

namespace anvil {

Scene scene_of_all_kinds(DeviceState& device) {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0.5}, {1, -1, 0.5}, {0, 1, 0.5}};
    mesh.add_polygon(std::array<uint32_t, 3>{0, 1, 2});
    triangulate(mesh);
    SceneItem solid;
    solid.mesh = std::make_shared<DrawnMesh>(device, mesh, mesh.positions, Vec3(0), false);
    solid.edges = true;
    SceneItem translucent = solid;
    translucent.edges = false;
    translucent.colour.a = 0.5F;
    Scene scene;
    scene.items = {solid, translucent};
    return scene;
}

bool ScenePicture::Sight::serves(const Scene& wanted, const PictureWish& wish) const {
    return drawn && drawn->size == wish.size && (fine || !wish.fine) && scene == wanted;
}

ScenePicture::ScenePicture(DeviceState& device, vk::Format window, bool in_parts, Disposer& disposer)
    : device_(device),
      // Drawn in linear light; the window's image takes the same bytes as they are.
      format_(window == vk::Format::eB8G8R8A8Unorm ? vk::Format::eB8G8R8A8Srgb : vk::Format::eR8G8B8A8Srgb),
      in_parts_(in_parts), disposer_(disposer) {}

void ScenePicture::drop(Sight& sight) {
    if (sight.scene) {
        disposer_.take_value(std::move(*sight.scene));
    }
    sight = {};
}

ScenePicture::Canvas& ScenePicture::canvas(bool fine) {
    std::optional<Canvas>& canvas = fine ? fine_ : plain_;
    if (!canvas) {
        const vk::SampleCountFlagBits samples =
            fine ? RenderTarget::sample_count(device_) : vk::SampleCountFlagBits::e1;
        const TargetFormat format{format_, RenderTarget::depth_format(device_), samples};
        canvas.emplace(Canvas{format, ScenePass(device_, format), {}, {}});
    }
    return *canvas;
}

/// A picture of this size that is not shown.
std::shared_ptr<ScenePicture::Drawn> ScenePicture::unused(Canvas& canvas, WindowSize size) const {
    std::erase_if(canvas.drawn, [&](const auto& drawn) { return drawn->size != size; });
    for (const std::shared_ptr<Drawn>& drawn : canvas.drawn) {
        if (drawn != shown_.drawn && drawn != base_.drawn) {
            return drawn;
        }
    }
    return canvas.drawn.emplace_back(std::make_shared<Drawn>(
        Drawn{RenderTarget(device_, static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height),
                           canvas.format.samples, canvas.format.colour, true),
              size}));
}

std::optional<SceneParts> ScenePicture::parts_for(const Scene& scene, const PictureWish& wish) const {
    return in_parts_ && wish.steady && !wish.fine ? parts_of(scene) : std::nullopt;
}

/// Whether what grows is what this scene wants.
bool ScenePicture::goes_on(const Scene& scene, const PictureWish& wish) const {
    if (!grows_base_) {
        return growing_.serves(scene, wish);
    }
    const std::optional<SceneParts> parts = wish.whole ? std::nullopt : parts_for(scene, wish);
    return parts && growing_.serves(parts->base, wish);
}

/// Whether what grows is given up for this scene.
bool ScenePicture::gives_way(const Scene& scene, const PictureWish& wish) {
    if (grows_base_ || wish.whole || growing_.drawn->size != wish.size || (growing_.fine && !wish.fine) ||
        growing_.scene == scene) {
        return true;
    }
    const std::optional<SceneParts> parts = parts_for(scene, wish);
    const bool on_base = parts && base_.serves(parts->base, wish);
    Canvas& drawn_to = canvas(wish.fine);
    return drawn_to.pass.size(on_base ? parts->rest : scene) <= drawn_to.part_size.next();
}

void ScenePicture::begin(const Scene& scene, const PictureWish& wish) {
    // While the base changes from step to step, none would ever be done.
    base_pays_ = base_pays_ && !(growing_.drawn && grows_base_);
    drop(growing_);
    rest_.reset();
    std::optional<SceneParts> parts = parts_for(scene, wish);
    const bool on_base = parts && base_.serves(parts->base, wish);
    grows_base_ = parts && !on_base && base_pays_ && !wish.whole && shown_.drawn;
    if (!on_base) {
        drop(base_); // one surface is kept from being freed, not two
    }
    Canvas& drawn_to = canvas(wish.fine);
    growing_ = {scene, wish.fine, unused(drawn_to, wish.size)};
    if (grows_base_) {
        growing_.scene = std::move(parts->base);
    }
    if (on_base) {
        rest_ = std::move(parts->rest);
    }
    drawn_to.pass.prepare(drawn_now());
    full_size_ = drawn_to.pass.size(drawn_now());
    grown_ = 0;
}

FrameKind ScenePicture::prepare(const Scene& scene, const PictureWish& wish) {
    complete_ = shown_.serves(scene, wish);
    draws_ = !complete_;
    if (complete_) {
        drop(growing_);
        return FrameKind::panels;
    }
    if (!growing_.drawn || (!goes_on(scene, wish) && gives_way(scene, wish))) {
        begin(scene, wish);
    }
    const bool at_once = wish.whole || !in_parts_ || !shown_.drawn; // nothing else could be shown meanwhile
    const uint64_t part = at_once ? full_size_ : canvas(growing_.fine).part_size.next();
    // A little more at once costs less than a part of its own.
    part_end_ = full_size_ - grown_ <= part + part / 2 ? full_size_ : grown_ + part;
    const bool last = part_end_ == full_size_;
    drew_fine_ = growing_.fine;
    complete_ = last && !grows_base_ && growing_.serves(scene, wish);
    return last && grown_ == 0 && !grows_base_ ? FrameKind::whole_surface : FrameKind::part_of_surface;
}

void ScenePicture::record(const vk::raii::CommandBuffer& commands) {
    if (!draws_) {
        return;
    }
    const bool last = part_end_ == full_size_;
    const RenderTarget& target = growing_.drawn->target;
    const bool on_base = grown_ == 0 && rest_;
    if (on_base) {
        target.copy_from(commands, base_.drawn->target);
    }
    target.begin(commands, {grown_ == 0 && !on_base, last});
    canvas(growing_.fine).pass.record(commands, drawn_now(), grown_, part_end_);
    target.end(commands, last);
    if (last) {
        finish();
    }
}

void ScenePicture::finish() {
    Sight& done = grows_base_ ? base_ : shown_;
    drop(done);
    done = std::exchange(growing_, {});
    base_pays_ = base_pays_ || !grows_base_;
    grows_base_ = false;
    rest_.reset();
}

void ScenePicture::took(double milliseconds) {
    if (draws_) {
        canvas(drew_fine_).part_size.took(part_end_ - grown_, milliseconds);
        grown_ = part_end_;
        draws_ = false;
    }
}

} // namespace anvil
