#include "app/viewer/folder_listing.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> names(const FolderListing& listing) {
    std::vector<std::string> all;
    for (const FolderEntry& entry : listing.entries) {
        all.push_back(entry.name);
    }
    return all;
}

} // namespace

TEST_CASE("a folder lists folders first, then files of the kinds asked for, by name in any case") {
    const ScratchFolder scratch;
    const fs::path folder = scratch / "listed";
    for (const char* sub : {"zebra", "Apple", ".hidden"}) {
        fs::create_directories(folder / sub);
    }
    for (const char* file : {"b.PLY", "a.ply", "C.obj", "notes.txt", ".c.ply"}) {
        std::ofstream(folder / file) << "123";
    }
    fs::create_symlink(folder / "nowhere.ply", folder / "dangling.ply");
    const FolderListing listing = list_folder(folder, {".ply", ".obj"});
    CHECK(listing.complaint.empty());
    CHECK(names(listing) == std::vector<std::string>{"Apple", "zebra", "a.ply", "b.PLY", "C.obj"});
    CHECK(listing.entries[0].is_folder);
    CHECK(listing.entries[2].bytes == 3);
    CHECK(names(list_folder(folder, {})).back() == "notes.txt");
}

TEST_CASE("a folder that cannot be read is said, and nothing is thrown") {
    const ScratchFolder scratch;
    const FolderListing none = list_folder(scratch / "missing", {".ply"});
    CHECK(none.entries.empty());
    CHECK_THAT(none.complaint, Catch::Contains("missing"));
    std::ofstream(scratch / "file.ply") << "1";
    CHECK_FALSE(list_folder(scratch / "file.ply", {".ply"}).complaint.empty());
}

TEST_CASE("a dialog begins in the file's folder, or in the nearest one that is still there") {
    const ScratchFolder scratch;
    const fs::path folder = scratch / "there";
    fs::create_directories(folder);
    CHECK(folder_to_begin_in(folder / "mesh.ply") == folder);
    CHECK(folder_to_begin_in(folder) == folder);
    CHECK(folder_to_begin_in(folder / "gone" / "away" / "mesh.ply") == folder);
    CHECK(fs::is_directory(folder_to_begin_in("")));
}

TEST_CASE("sizes are read at a glance") {
    CHECK(file_size_text(0) == "0 B");
    CHECK(file_size_text(999) == "999 B");
    CHECK(file_size_text(1500) == "1.5 kB");
    CHECK(file_size_text(41'600'000) == "42 MB");
}
