// The part of a dialog in which a file is chosen: its folder, what lies in it, its name.
#pragma once

#include "app/viewer/folder_listing.h"

#include <optional>

namespace anvil {

class FileBrowser {
  public:
    /// Shows the folder of `file`, and its name. Files with other extensions are left out; the first one is
    /// that of a name without any, where a file is to be written.
    void begin(const std::filesystem::path& file, std::vector<std::string> extensions, bool writes);

    /// Within a window; the file that was taken, by double click, by Enter or otherwise. The arrows choose,
    /// Enter enters folders, Alt+up or Backspace in an empty name leads to the folder above.
    std::optional<std::filesystem::path> show();
    /// What the name says now; empty: nothing, or a folder that is entered instead.
    std::optional<std::filesystem::path> take();

  private:
    void go_to(const std::filesystem::path& folder);
    void choose(size_t entry);
    void show_folders_above();
    bool show_entry(size_t index);
    bool show_entries();
    bool show_name();
    void follow_keys();

    FolderListing listing_;
    std::vector<std::string> extensions_;
    bool writes_ = false;
    std::string name_;
    size_t chosen_ = 0;       ///< entry; as many as there are: none
    bool scrolls_ = false;    ///< to the chosen one
    int name_generation_ = 0; ///< a text field that is being edited takes no other text
    bool wants_focus_ = true;
};

} // namespace anvil
