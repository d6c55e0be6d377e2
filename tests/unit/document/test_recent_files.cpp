#include "engine/document/recent_files.h"

#include "engine/core/atomic_file.h"
#include "engine/core/scratch_folder.h"

#include <catch2/catch.hpp>

#include <set>
#include <sys/wait.h>
#include <unistd.h>

using namespace anvil;

namespace fs = std::filesystem;

namespace {

fs::path made(const ScratchFolder& folder, const std::string& name) {
    write_file_atomically(folder / name, std::string_view("x"));
    return folder / name;
}

} // namespace

TEST_CASE("recent files: most recent first, each once, ten at most, only those that are there") {
    const ScratchFolder folder;
    const RecentFiles recent(folder / "state");
    CHECK(recent.list().empty());
    for (int i = 0; i < 12; ++i) {
        recent.add(made(folder, "mesh " + std::to_string(i) + ".ply"));
    }
    std::vector<fs::path> files = recent.list();
    REQUIRE(files.size() == 10);
    CHECK(files.front() == folder / "mesh 11.ply");
    CHECK(files.back() == folder / "mesh 2.ply");
    recent.add(folder / "mesh 5.ply");
    files = recent.list();
    CHECK(files.size() == 10);
    CHECK(files.front() == folder / "mesh 5.ply");
    CHECK(std::set<fs::path>(files.begin(), files.end()).size() == 10);
    fs::remove(folder / "mesh 9.ply");
    CHECK(recent.list().size() == 9);
}

TEST_CASE("a damaged list of recent files is an empty one, and no folder none") {
    const ScratchFolder folder;
    const RecentFiles recent(folder.path());
    for (const std::string text : {"", "[\"a", "{}", "[1, null, {}]", "\xff\xfe"}) {
        write_file_atomically(folder / "recent.json", std::string_view(text));
        CHECK(recent.list().empty());
        recent.add(made(folder, "a.ply"));
        CHECK(recent.list() == std::vector<fs::path>{folder / "a.ply"});
    }
    const RecentFiles none(std::nullopt);
    none.add(folder / "a.ply");
    CHECK(none.list().empty());
}

TEST_CASE("two programs that add recent files at once lose none") {
    const ScratchFolder folder;
    for (int i = 0; i < 10; ++i) {
        made(folder, std::to_string(i));
    }
    std::vector<pid_t> children;
    for (int half = 0; half < 2; ++half) {
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            const RecentFiles recent(folder.path());
            for (int round = 0; round < 20; ++round) {
                recent.add(folder / std::to_string(5 * half + round % 5));
            }
            ::_exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        CHECK(status == 0);
    }
    CHECK(RecentFiles(folder.path()).list().size() == 10);
}
