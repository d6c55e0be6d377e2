#include "app/viewer/scene.h"

namespace anvil {

std::array<std::pair<const char*, Lights>, 4> light_names() {
    return {{{"studio", Lights::studio},
             {"clay", Lights::clay},
             {"metal", Lights::metal},
             {"stripes", Lights::stripes}}};
}

} // namespace anvil
