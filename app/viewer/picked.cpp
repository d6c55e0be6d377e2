#include "app/viewer/picked.h"

#include <glm/gtc/quaternion.hpp>

namespace anvil {

PickedPlace place_of(const SurfaceHit& hit) {
    return {hit.address, hit.position, hit.normal};
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
    }
    return count > 0 ? sum / static_cast<double>(count) : all.front().place.position;
}

} // namespace anvil
