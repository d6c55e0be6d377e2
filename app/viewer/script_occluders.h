// Lines of scripts that are about occluders: what panels and gizmo do.
#pragma once

#include "app/viewer/script.h"
#include "app/viewer/session.h"

#include <glm/glm.hpp>

namespace anvil {

/// `occluder ...`, `dilation ...` and `hammer ...`; false: another word. @throws InputError
bool play_occluder_line(const ScriptLine& line, Session& session);

/// Where in the window a mark of the selected occluder's gizmo can be grabbed: `free`, `move-x`, `plane-y`,
/// `turn-z`, `turn`, `scale`. @throws InputError
glm::dvec2 gizmo_place(const Session& session, const std::string& part);

/// The recipe that is open. @throws InputError
Recipe script_recipe(const Session& session);

} // namespace anvil
