// Where a picture is drawn before it is copied elsewhere; internal to engine/gpu and app/viewer.
#pragma once

#include "engine/gpu/device_state.h"

namespace anvil {

/// An image with its memory and view.
struct Attachment {
    vk::raii::DeviceMemory memory{nullptr}; ///< outlives the image bound to it
    vk::raii::Image image{nullptr};
    vk::raii::ImageView view{nullptr};
};

/// Multisampled colour and depth and the single-sampled colour they resolve to, in the layouts that drawing
/// starts from after begin().
class RenderTarget {
  public:
    static constexpr vk::Format colour_format = vk::Format::eR8G8B8A8Srgb; ///< of pictures

    /// `keeps_depth`: for depths() and copy_from(). @throws DeviceError if the size exceeds the device's
    /// limits or memory is out.
    RenderTarget(DeviceState& device, uint32_t width, uint32_t height, vk::SampleCountFlagBits samples,
                 vk::Format format = colour_format, bool keeps_depth = false);

    /// A picture may be drawn in parts, each with a begin() and end() of its own.
    struct Part {
        bool first = true;
        bool last = true;
    };

    /// Starts drawing (dynamic rendering), viewport and scissor set: the first part over a cleared picture.
    void begin(const vk::raii::CommandBuffer& commands, Part part) const;
    void begin(const vk::raii::CommandBuffer& commands) const { begin(commands, Part{}); }
    /// Ends drawing; after the last part the picture is ready to be copied from colour().
    void end(const vk::raii::CommandBuffer& commands, bool last = true) const;
    /// In place of a first part: colour and depth of a picture of the same kind and size that is done.
    /// @pre one sample a pixel, keeps_depth
    void copy_from(const vk::raii::CommandBuffer& commands, const RenderTarget& other) const;
    vk::Image colour() const { return *(multisampled_ ? resolved_ : colour_).image; }
    /// One depth a pixel, in the layout that shaders read once the last part is drawn. @pre keeps_depth
    vk::ImageView depths() const { return *(multisampled_ ? resolved_depth_ : depth_).view; }

    /// Depth format that every device of this kind can draw to.
    static vk::Format depth_format(const DeviceState& device);
    /// Four samples where the device has them for colour and depth, else one.
    static vk::SampleCountFlagBits sample_count(const DeviceState& device);

  private:
    uint32_t width_;
    uint32_t height_;
    bool multisampled_;
    bool keeps_depth_;
    Attachment colour_;
    Attachment resolved_;
    Attachment depth_;
    Attachment resolved_depth_;
};

} // namespace anvil
