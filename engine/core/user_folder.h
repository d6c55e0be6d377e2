// Where programs keep what belongs to their user.
#pragma once

#include <filesystem>
#include <optional>

namespace anvil {

/// The folder that the environment variable `own` names (none if it says "off"), else "anvil" in the one that
/// `shared` names, else in `in_home` of the home folder; none without a home. It need not exist.
std::optional<std::filesystem::path> user_folder(const char* own, const char* shared, const char* in_home);

/// For what should outlast a cache but is no document: ANVIL_STATE, XDG_STATE_HOME or ~/.local/state.
std::optional<std::filesystem::path> user_state_folder();

/// For what a user made and uses in many documents: ANVIL_DATA, XDG_DATA_HOME or ~/.local/share.
std::optional<std::filesystem::path> user_data_folder();

} // namespace anvil
