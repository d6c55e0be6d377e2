#include "engine/forge/mirror_edit.h"

#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr double default_merge = 0.005; // of the diagonal
constexpr double slack = 1e-9;          // of a length or the diagonal: a plane or axis given by numbers

class BothSides {
  public:
    BothSides(const Edit& edit, const std::string& place, SurfaceState& surface, double diagonal)
        : edit_(edit), place_(place), surface_(surface), axis_(edit.mirror->axis),
          origin_(edit.mirror->origin), merge_(edit.mirror->merge.value_or(default_merge * diagonal)) {
        if (edit.kind == EditKind::rotate) {
            turns_upright_ = stands_upright();
            if (!turns_upright_ && !lies_in_plane(slack * diagonal)) {
                throw InputError(place +
                                 ".axis: the mirror plane takes this axis to another one, and an edit "
                                 "has one; let it lie in the plane or stand upright on it, or give "
                                 "two edits");
            }
        }
    }

    Edit run() {
        Edit result = edit_;
        result.mirror.reset();
        add_handles(result);
        add_anchors(result);
        for (size_t i = 0; i < edit_.pinned.size(); ++i) {
            const Vec3 at = position(edit_.pinned[i], ".pinned[" + std::to_string(i) + "]");
            if (!near_plane(at)) {
                result.pinned.emplace_back(NearestAddress{image(at)});
            }
        }
        return result;
    }

  private:
    Vec3 image(Vec3 point) const {
        point[axis_] = 2 * origin_ - point[axis_];
        return point;
    }
    Vec3 image_of_vector(Vec3 v) const {
        v[axis_] = -v[axis_];
        return v;
    }
    bool near_plane(const Vec3& point) const { return std::abs(point[axis_] - origin_) <= merge_; }

    Vec3 position(const SurfaceAddress& address, const std::string& key) {
        return surface_.place_of(address, place_ + key);
    }

    bool stands_upright() const {
        const Vec3 along = glm::normalize(edit_.axis.direction);
        return std::abs(std::abs(along[axis_]) - 1) <= slack;
    }
    bool lies_in_plane(double tolerance) const {
        const Vec3 along = glm::normalize(edit_.axis.direction);
        return std::abs(along[axis_]) <= slack && std::abs(edit_.axis.origin[axis_] - origin_) <= tolerance;
    }

    void add_handles(Edit& result) {
        const size_t count = edit_.handles.size();
        std::vector<Vec3> places;
        for (size_t j = 0; j < count; ++j) {
            places.push_back(position(edit_.handles[j].at, ".handles[" + std::to_string(j) + "].at"));
        }
        twins_.assign(count, no_index);
        for (size_t j = 0; j < count; ++j) {
            const Vec3 there = image(places[j]);
            if (near_plane(places[j])) {
                result.handles[j] = along_plane(edit_.handles[j], places[j]);
                twins_[j] = static_cast<uint32_t>(j);
            } else if (std::none_of(places.begin(), places.end(), [&](const Vec3& other) {
                           return glm::distance(other, there) <= merge_;
                       })) {
                twins_[j] = static_cast<uint32_t>(result.handles.size());
                result.handles.push_back(mirrored(edit_.handles[j], there));
            }
        }
    }

    Handle mirrored(Handle handle, const Vec3& there) const {
        handle.at = NearestAddress{there};
        if (handle.by) {
            handle.by = image_of_vector(*handle.by);
        }
        if (handle.to) {
            handle.to = image(*handle.to);
        }
        for (Vec3& offset : handle.path) {
            offset = image_of_vector(offset);
        }
        if (handle.degrees && !turns_upright_) {
            handle.degrees = -*handle.degrees;
        }
        return handle;
    }

    /// What the target and its image have in common.
    Handle along_plane(Handle handle, const Vec3& at) const {
        if (handle.by) {
            (*handle.by)[axis_] = 0;
        }
        if (handle.to) {
            (*handle.to)[axis_] = at[axis_];
        }
        for (Vec3& offset : handle.path) {
            offset[axis_] = 0;
        }
        const bool stays = std::all_of(handle.path.begin(), handle.path.end(),
                                       [&](const Vec3& offset) { return offset == handle.path.front(); });
        if (!handle.path.empty() && stays) {
            handle.path.clear();
            handle.by = Vec3(0);
        }
        if (edit_.kind == EditKind::rotate && !turns_upright_) {
            handle.to.reset();
            handle.degrees = 0;
        }
        return handle;
    }

    void add_anchors(Edit& result) {
        for (size_t a = 0; a < edit_.anchors.size(); ++a) {
            const Anchors& given = edit_.anchors[a];
            const bool single = edit_.handles.empty() || twins_.at(given.handle) == given.handle;
            if (!single && twins_[given.handle] == no_index) {
                continue;
            }
            Anchors other{single ? given.handle : twins_[given.handle], {}, given.smooth_width};
            for (size_t i = 0; i < given.at.size(); ++i) {
                const std::string key = ".anchors[" + std::to_string(a) + "].at[" + std::to_string(i) + "]";
                bool in_plane = true;
                AnchorAddress twin = mirrored(given.at[i], key, in_plane);
                // Of a single handle these are there already.
                if (!single || !in_plane) {
                    other.at.push_back(std::move(twin));
                }
            }
            if (single) {
                auto& all = result.anchors[a].at;
                all.insert(all.end(), other.at.begin(), other.at.end());
            } else {
                result.anchors.push_back(std::move(other));
            }
        }
    }

    /// `in_plane`: it is its own image, as nearly as handles are.
    AnchorAddress mirrored(const AnchorAddress& anchor, const std::string& key, bool& in_plane) {
        if (const auto* line = std::get_if<PolylineAddress>(&anchor)) {
            PolylineAddress twin;
            for (size_t i = 0; i < line->points.size(); ++i) {
                const Vec3 at = position(line->points[i], key + ".polyline[" + std::to_string(i) + "]");
                in_plane = in_plane && near_plane(at);
                twin.points.emplace_back(NearestAddress{image(at)});
            }
            return twin;
        }
        if (const auto* face = std::get_if<WholeFaceAddress>(&anchor)) {
            const WholeFaceAddress twin =
                surface_.face_near(image(surface_.centre_of(*face, place_ + key)), place_ + key);
            in_plane = twin == *face;
            return twin;
        }
        const Vec3 at = position(std::get<SurfaceAddress>(anchor), key);
        in_plane = near_plane(at);
        return SurfaceAddress{NearestAddress{image(at)}};
    }

    const Edit& edit_;
    const std::string& place_;
    SurfaceState& surface_;
    int axis_;
    double origin_;
    double merge_;
    bool turns_upright_ = false;  ///< the axis is upright on the plane: both sides turn the same way
    std::vector<uint32_t> twins_; ///< per given handle: itself if single, no_index if another was given there
};

} // namespace

Edit on_both_sides(const Edit& edit, const std::string& place, SurfaceState& surface, double diagonal) {
    return edit.mirror ? BothSides(edit, place, surface, diagonal).run() : edit;
}

} // namespace anvil
