// The window in which meshes are forged.
#pragma once

#include <string>

namespace anvil {

struct ViewerOptions {
    std::string file;       ///< a mesh or a recipe; empty: nothing is open
    std::string script;     ///< plays this and ends; empty: a person is there
    std::string screenshot; ///< PNG of the last frame, at the end of the script or of the first picture
    std::string device = "auto";
    std::string bake = "auto"; ///< where distance fields are baked: auto, cpu or device
};

/// Returns when the window is closed or the script has ended.
/// @throws InputError, DeviceError, WriteError; InternalError if the validation layer is on and objects.
void run_viewer(const ViewerOptions& options);

} // namespace anvil
