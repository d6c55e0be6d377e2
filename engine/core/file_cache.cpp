#include "engine/core/file_cache.h"

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/read_file.h"
#include "engine/core/user_folder.h"

#include <algorithm>
#include <cstring>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace anvil {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view suffix = ".anvil-cache";
constexpr std::string_view magic = "anvil cache 1\n";

/// What is kept: magic, hash of the rest, length of the description, description, content.
constexpr size_t hash_size = 32;
constexpr size_t header_size = magic.size() + hash_size + sizeof(uint64_t);

std::string packed(const std::string& description, std::string_view content) {
    std::string body(sizeof(uint64_t), '\0');
    const uint64_t length = description.size();
    std::memcpy(body.data(), &length, sizeof length);
    body += description;
    body += content;
    std::string file(magic);
    file += content_hash(body);
    file += body;
    return file;
}

std::optional<std::string> unpacked(const std::string& file, const std::string& description) {
    if (file.size() < header_size + description.size() || !file.starts_with(magic)) {
        return std::nullopt;
    }
    const std::string_view body = std::string_view(file).substr(magic.size() + hash_size);
    uint64_t length = 0;
    std::memcpy(&length, body.data(), sizeof length);
    if (length != description.size() || body.substr(sizeof length, description.size()) != description ||
        content_hash(body) != std::string_view(file).substr(magic.size(), hash_size)) {
        return std::nullopt;
    }
    return file.substr(header_size + description.size());
}

} // namespace

std::string content_hash(std::string_view bytes) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
    std::string text;
    for (const unsigned char byte : canonical.digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

fs::path FileCache::file_of(const std::string& description) const {
    return folder_ / (content_hash(description) + std::string(suffix));
}

std::optional<std::string> FileCache::find(const std::string& description) const {
    const fs::path file = file_of(description);
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
        return std::nullopt;
    }
    try {
        std::optional<std::string> content = unpacked(read_file(file), description);
        if (content) {
            fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
        }
        return content;
    } catch (const InputError&) { // removed by another program meanwhile, or not ours to read
        return std::nullopt;
    }
}

void FileCache::keep(const std::string& description, std::string_view content) const {
    if (content.size() + description.size() + header_size > limit_) {
        return;
    }
    std::error_code failed;
    fs::create_directories(folder_, failed);
    try {
        write_file_atomically(file_of(description), packed(description, content));
    } catch (const WriteError&) { // no place: the next run works it out again
        return;
    }
    trim();
}

void FileCache::trim() const {
    struct Entry {
        fs::file_time_type used;
        uint64_t size;
        fs::path path;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    std::error_code failed;
    for (auto entry = fs::directory_iterator(folder_, failed); !failed && entry != fs::directory_iterator();
         entry.increment(failed)) {
        std::error_code vanished;
        const auto used = entry->last_write_time(vanished);
        const uint64_t size = entry->file_size(vanished);
        if (!vanished && entry->path().extension() == suffix) {
            entries.push_back({used, size, entry->path()});
            total += size;
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& oldest : entries) {
        if (total <= limit_) {
            return;
        }
        fs::remove(oldest.path, failed);
        total -= oldest.size;
    }
}

std::optional<FileCache> user_cache() {
    constexpr uint64_t limit = uint64_t{1} << 30;
    const std::optional<fs::path> folder = user_folder("ANVIL_CACHE", "XDG_CACHE_HOME", ".cache");
    return folder ? std::optional<FileCache>(FileCache(*folder, limit)) : std::nullopt;
}

} // namespace anvil
