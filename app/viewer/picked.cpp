#include "app/viewer/picked.h"

#include <glm/gtc/quaternion.hpp>

namespace anvil {

PickedPlace place_of(const SurfaceHit& hit) {
    return {hit.address, hit.position, hit.normal};
}

std::vector<SurfaceAddress> PickedLine::addresses() const {
    std::vector<SurfaceAddress> result;
    for (const PickedPlace& point : points) {
        result.push_back(point.at);
    }
    return result;
}

std::vector<Vec3> PickedLine::places() const {
    if (!path.empty()) {
        return path;
    }
    std::vector<Vec3> result;
    for (const PickedPlace& point : points) {
        result.push_back(point.position);
    }
    return result;
}

Vec3 PickedHandles::target(const PickedHandle& handle) const {
    if (!turns) {
        return handle.place.position + handle.by;
    }
    const glm::dquat turn = glm::angleAxis(glm::radians(handle.degrees), glm::normalize(axis.direction));
    return axis.origin + turn * (handle.place.position - axis.origin);
}

Vec3 PickedHandles::centre() const {
    Vec3 sum(0);
    size_t count = 0;
    for (const PickedHandle& handle : all) {
        for (const PickedPlace& anchor : handle.anchors) {
            sum += anchor.position;
            ++count;
        }
        for (const PickedLine& line : handle.anchor_lines) {
            for (const PickedPlace& point : line.points) {
                sum += point.position;
                ++count;
            }
        }
        for (const PickedFace& face : handle.anchor_faces) {
            sum += face.position;
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : all.front().place.position;
}

} // namespace anvil
