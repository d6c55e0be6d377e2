// What one frame of the viewer shows.
#pragma once

#include "app/viewer/drawn_mesh.h"

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace anvil {

/// What surfaces are lit by. All but the studio show form alone, or how smooth it is.
enum class Lights : uint8_t { studio, clay, metal, stripes };

/// By their names in scripts and menus.
std::array<std::pair<const char*, Lights>, 4> light_names();

struct SceneItem {
    std::shared_ptr<DrawnMesh> mesh;
    std::shared_ptr<const DrawnRegion> region;   ///< of an editable mesh; nullptr: none moves
    std::shared_ptr<const DrawnIndices> indices; ///< in place of the mesh's; nullptr: its own
    std::shared_ptr<const Buffer> selected;      ///< a number per vertex, 1: selected; nullptr: none is
    glm::mat4 model_view{1};                     ///< from the mesh's local space
    glm::vec4 colour{0.66F, 0.51F, 0.40F, 1};    ///< linear; alpha < 1: translucent
    Lights lights = Lights::studio;
    bool flat = false;
    bool edges = false;        ///< the polygons' edges over it
    bool tinted = true;        ///< the region in colours
    bool plain_back = false;   ///< back faces look as front faces do
    float contour_spacing = 0; ///< world; 0: no lines
    float contour_end = 0;     ///< no lines beyond

    bool operator==(const SceneItem&) const = default;
};

struct Scene {
    std::vector<SceneItem> items;
    glm::mat4 projection{1};
    bool orthographic = false;
    bool over_picture = false; ///< no background: what it is drawn over is there

    bool operator==(const Scene&) const = default;
};

/// A scene in two: `base` can be kept while a drag moves a region, `rest` is drawn over its picture.
struct SceneParts {
    Scene base;
    Scene rest;
};

/// Nothing where no region is told apart from the mesh around it (DrawnRegion::outside), or it has to be
/// drawn in another way.
std::optional<SceneParts> parts_of(const Scene& scene);

} // namespace anvil
