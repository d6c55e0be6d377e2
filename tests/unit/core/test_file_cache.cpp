#include "engine/core/file_cache.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

using namespace anvil;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        files.push_back(entry.path());
    }
    return files;
}

uint64_t bytes_in(const fs::path& folder) {
    uint64_t total = 0;
    for (const fs::path& file : files_of(folder)) {
        total += fs::file_size(file);
    }
    return total;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

} // namespace

TEST_CASE("Hashes are those of XXH3 with 128 bits, most significant digit first") {
    // The published test vector of the empty input with seed 0.
    CHECK(content_hash("") == "99aa06d3014798d86001c324468d497f");
    CHECK(content_hash("anvil") != content_hash("anvil "));
}

TEST_CASE("A cache gives back what it was given, by its whole description") {
    const ScratchFolder folder;
    const FileCache cache(folder.path() / "deep" / "cache", 1 << 20);
    CHECK_FALSE(cache.find("a"));
    const std::string content("bytes\0with zero", 15);
    cache.keep("a", content);
    cache.keep("b", "");
    CHECK(cache.find("a") == content);
    CHECK(cache.find("b") == "");
    CHECK_FALSE(cache.find("c"));
    cache.keep("a", "newer");
    CHECK(cache.find("a") == "newer");
}

TEST_CASE("A damaged or foreign file in the cache is as if it were not there, and is replaced") {
    const ScratchFolder folder;
    const FileCache cache(folder / "own", 1 << 20);
    cache.keep("field", "some content");
    const fs::path file = files_of(cache.folder()).at(0);
    const std::string whole = bytes_of(file);
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 1);
        std::ofstream(file, std::ios::binary) << damaged;
        REQUIRE_FALSE(cache.find("field"));
        std::ofstream(file, std::ios::binary) << whole.substr(0, i);
        REQUIRE_FALSE(cache.find("field"));
    }
    const FileCache other(folder / "other", 1 << 20);
    other.keep("another", "some content");
    fs::copy_file(files_of(other.folder()).at(0), file, fs::copy_options::overwrite_existing);
    CHECK_FALSE(cache.find("field"));
    cache.keep("field", "again");
    CHECK(cache.find("field") == "again");
}

TEST_CASE("A cache stays within its limit and lets go what was used longest ago") {
    const ScratchFolder folder;
    const FileCache cache(folder.path(), 3500); // three of the four below
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
    for (const char* name : {"a", "b", "c"}) {
        cache.keep(name, std::string(1000, *name));
        pause();
    }
    REQUIRE(cache.find("a")); // used again: now "b" is the oldest
    pause();
    cache.keep("d", std::string(1000, 'd'));
    CHECK(bytes_in(folder.path()) <= 3500);
    CHECK(cache.find("a"));
    CHECK_FALSE(cache.find("b"));
    CHECK(cache.find("d"));
    cache.keep("huge", std::string(5000, 'x'));
    CHECK_FALSE(cache.find("huge"));
    CHECK(cache.find("d"));
}

TEST_CASE("Files of others in the cache's folder are left alone") {
    const ScratchFolder folder;
    std::ofstream(folder / "notes.txt") << std::string(10000, 'n');
    const FileCache cache(folder.path(), 1000);
    cache.keep("a", std::string(600, 'a'));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    cache.keep("b", std::string(600, 'b'));
    CHECK(fs::exists(folder / "notes.txt"));
    CHECK(cache.find("b"));
    CHECK_FALSE(cache.find("a"));
}

TEST_CASE("A cache that cannot be written keeps nothing and says nothing") {
    const ScratchFolder folder;
    std::ofstream(folder / "file") << "no folder";
    const FileCache cache(folder / "file", 1000);
    cache.keep("a", "content");
    CHECK_FALSE(cache.find("a"));
}

TEST_CASE("Threads that fill and read one cache at once see whole results only") {
    const ScratchFolder folder;
    std::vector<std::thread> threads;
    std::vector<size_t> wrong(4);
    for (size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            const FileCache cache(folder.path(), 20000);
            for (int i = 0; i < 100; ++i) {
                const std::string name = std::to_string(i % 7);
                cache.keep(name, std::string(3000, name[0]));
                const auto found = cache.find(name);
                wrong[t] += found && *found != std::string(3000, name[0]);
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(wrong == std::vector<size_t>(4, 0));
}
