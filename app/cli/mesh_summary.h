// What `anvil info` says about a mesh.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/health.h"
#include "engine/mesh/mesh.h"

#include <string>

namespace anvil {

/// A line per fact, for people; what is wrong names the first place.
std::string summary_table(const std::string& file, const Mesh& mesh, const MeshHealth& health);

/// A JSON object with stable keys, a fact each; findings are {"count", "first"} with first null where the
/// count is 0; volume is null for open meshes; `warnings` are those of the log.
std::string summary_json(const std::string& file, const Mesh& mesh, const MeshHealth& health, const Log& log);

} // namespace anvil
