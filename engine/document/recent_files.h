// The files that were opened last, in a small file that any number of programs may share.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace anvil {

/// At most ten, most recent first. It never fails: without a folder, or where it cannot be written, nothing
/// is remembered.
class RecentFiles {
  public:
    explicit RecentFiles(const std::optional<std::filesystem::path>& folder);

    /// Puts the file first.
    void add(const std::filesystem::path& file) const;
    /// Those that are still there, by absolute paths.
    std::vector<std::filesystem::path> list() const;

  private:
    std::vector<std::filesystem::path> read() const;

    std::filesystem::path file_; ///< empty: none
};

} // namespace anvil
