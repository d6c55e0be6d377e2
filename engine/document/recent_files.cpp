#include "engine/document/recent_files.h"

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/file_lock.h"
#include "engine/core/read_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace anvil {

namespace fs = std::filesystem;

namespace {

constexpr size_t most = 10;

} // namespace

RecentFiles::RecentFiles(const std::optional<fs::path>& folder)
    : file_(folder ? *folder / "recent.json" : fs::path()) {}

/// What is damaged is as if it were not there.
std::vector<fs::path> RecentFiles::read() const {
    std::vector<fs::path> files;
    std::error_code unknown;
    if (file_.empty() || !fs::exists(file_, unknown)) {
        return files;
    }
    std::string text;
    try {
        text = read_file(file_);
    } catch (const InputError&) {
        return files;
    }
    const nlohmann::json list = nlohmann::json::parse(text, nullptr, false);
    if (list.is_array()) {
        for (const nlohmann::json& entry : list) {
            if (entry.is_string()) {
                files.emplace_back(entry.get<std::string>());
            }
        }
    }
    return files;
}

void RecentFiles::add(const fs::path& file) const {
    if (file_.empty()) {
        return;
    }
    std::error_code failed;
    fs::create_directories(file_.parent_path(), failed);
    // Two programs that read, then write, would lose what the other one adds.
    const auto lock = FileLock::wait_for(fs::path(file_).replace_extension("lock"));
    const fs::path absolute = fs::absolute(file).lexically_normal();
    std::vector<fs::path> files = read();
    std::erase(files, absolute);
    files.insert(files.begin(), absolute);
    files.resize(std::min(files.size(), most));
    nlohmann::json list = nlohmann::json::array();
    for (const fs::path& entry : files) {
        list.push_back(entry.string());
    }
    try {
        // Names of files need not be UTF-8.
        write_file_atomically(file_,
                              list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const WriteError&) {
        return;
    }
}

std::vector<fs::path> RecentFiles::list() const {
    std::vector<fs::path> files = read();
    std::erase_if(files, [](const fs::path& file) {
        std::error_code unknown;
        return !fs::exists(file, unknown);
    });
    return files;
}

} // namespace anvil
