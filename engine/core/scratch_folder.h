// A folder for temporary files.
#pragma once

#include "engine/core/error.h"

#include <filesystem>
#include <stdlib.h> // mkdtemp
#include <string>

namespace anvil {

/// Made with a name of its own where the system keeps temporary files; gone with its content at the end.
class ScratchFolder {
  public:
    /// @throws WriteError
    ScratchFolder() {
        std::string path = std::filesystem::temp_directory_path() / "anvil-XXXXXX";
        if (::mkdtemp(path.data()) == nullptr) {
            throw WriteError(path + ": no temporary folder can be made here; set TMPDIR to one that can be "
                                    "written");
        }
        path_ = path;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

} // namespace anvil
