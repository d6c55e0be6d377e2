// What a folder holds that a dialog may offer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace anvil {

struct FolderEntry {
    std::string name;
    bool is_folder = false;
    uintmax_t bytes = 0; ///< of files
};

struct FolderListing {
    std::filesystem::path folder;     ///< absolute
    std::vector<FolderEntry> entries; ///< folders first, each sort by name; none that begin with a dot
    std::string complaint;            ///< why nothing or not all is listed; empty: all is
};

/// Folders, and files whose names end in one of these (".ply", in any case; none given: all files). What
/// cannot be read is said, not thrown; a link that leads nowhere is left out.
FolderListing list_folder(const std::filesystem::path& folder, const std::vector<std::string>& extensions);

/// Where a dialog begins: the folder of `file`, or the nearest one above it that is there, else the working
/// folder.
std::filesystem::path folder_to_begin_in(const std::filesystem::path& file);

/// "3.2 MB"
std::string file_size_text(uintmax_t bytes);

} // namespace anvil
