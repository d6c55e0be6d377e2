// The plane of a mirrored edit as a translucent sheet.
#pragma once

#include "app/viewer/scene.h"
#include "engine/edit/recipe.h"

namespace anvil {

class MirrorPlane {
  public:
    /// Where the sheet lies: it spans -1 to 1 of the first two axes.
    struct Place {
        Vec3 origin{0};
        glm::mat3 axes{1}; ///< the third upright on the plane

        std::array<Vec3, 4> corners() const;
    };

    /// @throws DeviceError
    explicit MirrorPlane(DeviceState& device);

    /// A little larger than the scene (world) seen along the mirror's axis.
    static Place place(const Mirror& mirror, const Box& scene);
    /// All but `model_view`.
    SceneItem item() const;

  private:
    std::shared_ptr<DrawnMesh> sheet_;
};

} // namespace anvil
