#include "engine/gpu/offscreen_renderer.h"

#include "engine/gpu/buffer.h"
#include "engine/gpu/render_target.h"
#include "engine/gpu/surface_pipelines.h"
#include "engine/gpu/surface_vertices.h"

#include <algorithm>
#include <optional>

namespace anvil {

namespace {

/// A surface on the device.
struct Drawable {
    Buffer vertices;
    Buffer indices;
    uint32_t index_count = 0;
    float opacity = 1;
    float contour_spacing = 0;
    float contour_end = 1;
    double depth = 0; ///< of its centre, from the eye
};

Drawable upload(DeviceState& device, const PictureSurface& surface, const glm::dmat4& view) {
    const SurfaceGeometry geometry = surface_geometry(surface, view);
    Drawable drawable;
    drawable.opacity = surface.opacity;
    drawable.contour_spacing = surface.contour_spacing;
    drawable.contour_end = surface.contour_end;
    drawable.index_count = static_cast<uint32_t>(geometry.indices.size());
    drawable.depth = -(view * glm::dvec4(bounds(surface).centre(), 1)).z;
    const std::span<const SurfaceVertex> vertices = geometry.vertices;
    const std::span<const uint32_t> indices = geometry.indices;
    drawable.vertices =
        Buffer(device, vertices.size_bytes(), vk::BufferUsageFlagBits::eVertexBuffer, MemoryUse::device);
    drawable.vertices.write_all(vertices);
    drawable.indices =
        Buffer(device, indices.size_bytes(), vk::BufferUsageFlagBits::eIndexBuffer, MemoryUse::device);
    drawable.indices.write_all(indices);
    return drawable;
}

/// sRGB byte to linear light and back, for the averages of supersampling.
double linear_of(uint8_t value) {
    const double s = value / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

uint8_t srgb_of(double linear) {
    const double s = linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(std::clamp(s * 255 + 0.5, 0.0, 255.0));
}

Picture halved(const Picture& big) {
    Picture picture{big.width / 2, big.height / 2, {}};
    picture.rgba.reserve(big.rgba.size() / 4);
    for (size_t y = 0; y < picture.height; ++y) {
        for (size_t x = 0; x < picture.width; ++x) {
            for (size_t channel = 0; channel < 4; ++channel) {
                const auto at = [&](size_t dx, size_t dy) {
                    return linear_of(big.rgba[4 * ((2 * y + dy) * big.width + 2 * x + dx) + channel]);
                };
                picture.rgba.push_back(srgb_of((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4));
            }
        }
    }
    return picture;
}

TargetFormat target_format(const DeviceState& device) {
    if (!device.info.graphics) {
        throw DeviceError("device \"" + device.info.name + "\" cannot draw pictures (no graphics queue)");
    }
    return {RenderTarget::colour_format, RenderTarget::depth_format(device),
            RenderTarget::sample_count(device)};
}

} // namespace

struct OffscreenRenderer::Impl {
    DeviceState& device;
    TargetFormat format;
    SurfacePipelines pipelines;

    explicit Impl(DeviceState& state)
        : device(state), format(target_format(state)), pipelines(state, target_format(state)) {}

    void draw(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline,
              const Drawable& item, shader::SurfaceParameters parameters) const {
        parameters.opacity = item.opacity;
        parameters.contour_spacing = item.contour_spacing;
        parameters.contour_end = item.contour_end;
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.pushConstants<shader::SurfaceParameters>(
            *pipelines.layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
            parameters);
        commands.bindVertexBuffers(0, item.vertices.handle(), vk::DeviceSize{0});
        commands.bindIndexBuffer(item.indices.handle(), 0, vk::IndexType::eUint32);
        commands.drawIndexed(item.index_count, 1, 0, 0, 0);
    }

    void draw_all(const vk::raii::CommandBuffer& commands, const std::vector<Drawable>& items,
                  const shader::SurfaceParameters& parameters) const {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.background);
        commands.draw(3, 1, 0, 0);
        for (const Drawable& item : items) {
            if (item.opacity >= 1) {
                draw(commands, pipelines.opaque, item, parameters);
            }
        }
        for (const Drawable& item : items) { // sorted: farthest first
            if (item.opacity < 1) {
                draw(commands, pipelines.translucent_back, item, parameters);
                draw(commands, pipelines.translucent_front, item, parameters);
            }
        }
    }

    Picture picture_of(const std::vector<Drawable>& items, const shader::SurfaceParameters& parameters,
                       uint32_t width, uint32_t height) {
        const RenderTarget target(device, width, height, format.samples);
        const Buffer pixels(device, uint64_t{4} * width * height, {}, MemoryUse::download);
        guarded("drawing a picture", [&] {
            run_commands(device, [&](const vk::raii::CommandBuffer& commands) {
                target.begin(commands);
                draw_all(commands, items, parameters);
                target.end(commands);
                const vk::BufferImageCopy region{
                    .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                    .imageExtent = {width, height, 1}};
                commands.copyImageToBuffer(target.colour(), vk::ImageLayout::eTransferSrcOptimal,
                                           pixels.handle(), region);
            });
        });
        Picture picture{width, height, std::vector<uint8_t>(pixels.size())};
        pixels.read(0, std::as_writable_bytes(std::span(picture.rgba)));
        return picture;
    }
};

OffscreenRenderer::OffscreenRenderer(Device& device) : impl_(std::make_unique<Impl>(device.state())) {}
OffscreenRenderer::~OffscreenRenderer() = default;
OffscreenRenderer::OffscreenRenderer(OffscreenRenderer&&) noexcept = default;

Picture OffscreenRenderer::render(std::span<const PictureSurface> surfaces, const PictureView& view,
                                  PictureSize size) {
    const bool anything = std::any_of(surfaces.begin(), surfaces.end(),
                                      [](const PictureSurface& surface) { return !bounds(surface).empty(); });
    PictureCamera camera;
    std::vector<Drawable> items;
    if (anything) {
        camera = frame_surfaces(surfaces, view, static_cast<double>(size.width) / size.height);
        for (const PictureSurface& surface : surfaces) {
            Drawable item = upload(impl_->device, surface, camera.view);
            if (item.index_count > 0) {
                items.push_back(std::move(item));
            }
        }
    }
    std::stable_sort(items.begin(), items.end(),
                     [](const Drawable& a, const Drawable& b) { return a.depth > b.depth; });
    const shader::SurfaceParameters parameters{camera.projection, 1.0F, view.orthographic ? 1.0F : 0.0F, 0.0F,
                                               1.0F};
    if (impl_->format.samples != vk::SampleCountFlagBits::e1) {
        return impl_->picture_of(items, parameters, size.width, size.height);
    }
    return halved(impl_->picture_of(items, parameters, 2 * size.width, 2 * size.height));
}

} // namespace anvil
