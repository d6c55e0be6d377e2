#include "app/viewer/folder_listing.h"

#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

bool is_offered(const fs::path& file, const std::vector<std::string>& extensions) {
    return extensions.empty() || std::find(extensions.begin(), extensions.end(),
                                           lower(file.extension().string())) != extensions.end();
}

void add_entry(FolderListing& listing, const fs::directory_entry& entry,
               const std::vector<std::string>& extensions) {
    const std::string name = entry.path().filename().string();
    std::error_code failed;
    if (name.starts_with('.')) {
        return;
    }
    if (entry.is_directory(failed)) {
        listing.entries.push_back({name, true, 0});
    } else if (entry.is_regular_file(failed) && is_offered(entry.path(), extensions)) {
        const uintmax_t bytes = entry.file_size(failed);
        listing.entries.push_back({name, false, failed ? 0 : bytes});
    }
}

} // namespace

FolderListing list_folder(const fs::path& folder, const std::vector<std::string>& extensions) {
    FolderListing listing;
    std::error_code failed;
    listing.folder = fs::absolute(folder, failed).lexically_normal();
    for (fs::directory_iterator entry(listing.folder, failed); !failed && entry != fs::directory_iterator();
         entry.increment(failed)) {
        add_entry(listing, *entry, extensions);
    }
    if (failed) {
        listing.complaint = listing.folder.string() + " cannot be read: " + failed.message();
    }
    std::sort(listing.entries.begin(), listing.entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
        return a.is_folder != b.is_folder       ? a.is_folder
               : lower(a.name) != lower(b.name) ? lower(a.name) < lower(b.name)
                                                : a.name < b.name;
    });
    return listing;
}

fs::path folder_to_begin_in(const fs::path& file) {
    std::error_code failed;
    fs::path folder = file.empty() ? fs::path() : fs::absolute(file, failed).lexically_normal();
    while (!folder.empty() && !fs::is_directory(folder, failed) && folder != folder.parent_path()) {
        folder = folder.parent_path();
    }
    if (folder.empty() || !fs::is_directory(folder, failed)) {
        folder = fs::current_path(failed);
    }
    return failed ? fs::path("/") : folder;
}

std::string file_size_text(uintmax_t bytes) {
    double size = static_cast<double>(bytes);
    const char* unit = " B";
    for (const char* larger : {" kB", " MB", " GB"}) {
        if (size < 1000) {
            break;
        }
        size /= 1000;
        unit = larger;
    }
    return rounded_text(size < 10 ? std::round(size * 10) / 10 : std::round(size)) + unit;
}

} // namespace anvil
