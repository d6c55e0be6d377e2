#include "app/viewer/scene.h"

#include <algorithm>

namespace anvil {

std::array<std::pair<const char*, Lights>, 4> light_names() {
    return {{{"studio", Lights::studio},
             {"clay", Lights::clay},
             {"metal", Lights::metal},
             {"stripes", Lights::stripes}}};
}

namespace {

bool comes_apart(const SceneItem& item) {
    return item.region && item.region->outside && !item.indices && !item.edges && item.colour.a >= 1;
}

} // namespace

std::optional<SceneParts> parts_of(const Scene& scene) {
    if (std::none_of(scene.items.begin(), scene.items.end(), comes_apart)) {
        return std::nullopt;
    }
    SceneParts parts{scene, scene};
    parts.base.items.clear();
    parts.rest.items.clear();
    parts.rest.over_picture = true;
    for (const SceneItem& item : scene.items) {
        if (comes_apart(item)) {
            SceneItem outside = item;
            outside.indices = item.region->outside;
            outside.region.reset();
            parts.base.items.push_back(std::move(outside));
            parts.rest.items.push_back(item);
            parts.rest.items.back().indices = item.region->inside;
        } else {
            (item.colour.a < 1 ? parts.rest : parts.base).items.push_back(item);
        }
    }
    return parts;
}

} // namespace anvil
