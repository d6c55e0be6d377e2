// What one frame of the viewer shows.
#pragma once

#include "app/viewer/drawn_mesh.h"

#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace anvil {

struct SceneItem {
    std::shared_ptr<DrawnMesh> mesh;
    std::shared_ptr<const DrawnRegion> region; ///< of an editable mesh; nullptr: none moves
    glm::mat4 model_view{1};                   ///< from the mesh's local space
    glm::vec4 colour{0.66F, 0.51F, 0.40F, 1};  ///< linear; alpha < 1: translucent
    bool flat = false;
    bool edges = false;        ///< the polygons' edges over it
    bool tinted = true;        ///< the region in colours
    bool plain_back = false;   ///< back faces look as front faces do
    float contour_spacing = 0; ///< world; 0: no lines
};

struct Scene {
    std::vector<SceneItem> items;
    glm::mat4 projection{1};
    bool orthographic = false;
};

} // namespace anvil
