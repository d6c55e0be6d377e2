#include "engine/core/user_folder.h"

#include <cstdlib>
#include <string>

namespace anvil {

namespace fs = std::filesystem;

namespace {

std::string variable(const char* name) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets any
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

} // namespace

std::optional<fs::path> user_folder(const char* own, const char* shared, const char* in_home) {
    if (const std::string given = variable(own); !given.empty()) {
        return given == "off" ? std::nullopt : std::optional<fs::path>(given);
    }
    if (const std::string folder = variable(shared); !folder.empty()) {
        return fs::path(folder) / "anvil";
    }
    const std::string home = variable("HOME");
    return home.empty() ? std::nullopt : std::optional<fs::path>(fs::path(home) / in_home / "anvil");
}

std::optional<fs::path> user_state_folder() {
    return user_folder("ANVIL_STATE", "XDG_STATE_HOME", ".local/state");
}

std::optional<fs::path> user_data_folder() {
    return user_folder("ANVIL_DATA", "XDG_DATA_HOME", ".local/share");
}

} // namespace anvil
