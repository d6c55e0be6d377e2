// Results that took long, kept on disk between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace anvil {

/// 128-bit hash (XXH3) of bytes, as 32 hexadecimal digits: good against accident, not against intent.
std::string content_hash(std::string_view bytes);

/// A folder of results, each under a description of all that it depends on. Any number of programs may use
/// it at once: files appear whole, and what is damaged, cut short or of another description is as if it were
/// not there. It never fails: where the disk is full or the folder cannot be written, nothing is kept.
class FileCache {
  public:
    /// `limit`: bytes in all; what was used longest ago goes first.
    FileCache(std::filesystem::path folder, uint64_t limit) : folder_(std::move(folder)), limit_(limit) {}

    std::optional<std::string> find(const std::string& description) const;
    void keep(const std::string& description, std::string_view content) const;

    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path file_of(const std::string& description) const;
    void trim() const;

    std::filesystem::path folder_;
    uint64_t limit_;
};

/// The user's own: the folder that ANVIL_CACHE names (none if that is "off"), else "anvil" in XDG_CACHE_HOME
/// or ~/.cache; up to 1 GiB.
std::optional<FileCache> user_cache();

} // namespace anvil
