#include "engine/document/autosave.h"

#include "engine/core/atomic_file.h"
#include "engine/core/read_file.h"
#include "tests/unit/document/session.h"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

using namespace anvil;
using namespace anvil::test;

namespace fs = std::filesystem;

namespace {

Recipe some_recipe(const fs::path& mesh) {
    Recipe recipe;
    recipe.file = "/somewhere/pull.json";
    recipe.mesh = mesh.string();
    recipe.edits.push_back(pull(Vec3(0, 1, 0), 0.25));
    return recipe;
}

size_t count_files(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Runs in a process of its own that is killed once it says that it is ready.
template <class Work>
void killed_after(const Work& work) {
    int ready[2] = {};
    REQUIRE(::pipe(ready) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        work([&] {
            const char done = 1;
            (void)!::write(ready[1], &done, 1);
            ::pause();
        });
        ::_exit(1);
    }
    char done = 0;
    CHECK(::read(ready[0], &done, 1) == 1);
    CHECK(::kill(child, SIGKILL) == 0);
    int status = 0;
    CHECK(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    ::close(ready[0]);
    ::close(ready[1]);
}

} // namespace

TEST_CASE("a session that is killed is recovered by the next one, as it was left") {
    Session s;
    const fs::path state = s.folder / "state";
    killed_after([&](const auto& ready) {
        Log log;
        Autosave autosave(state);
        Recipe recipe = some_recipe(s.mesh);
        autosave.commit(recipe, log);
        recipe.edits[0].amount = 0.5;
        autosave.commit(recipe, log);
        ready();
    });
    std::vector<LostSession> lost = lost_sessions(state, s.log);
    REQUIRE(lost.size() == 1);
    Recipe expected = some_recipe(s.mesh);
    expected.edits[0].amount = 0.5;
    CHECK(lost[0].recipe == expected);
    CHECK(lost[0].time.size() == 20);
    // While it is offered here, nobody else offers it.
    CHECK(lost_sessions(state, s.log).empty());

    const auto document = Document::open_unsaved(lost[0].recipe, s.work);
    CHECK(document->unsaved());
    CHECK(document->recipe_file() == "/somewhere/pull.json");
    check_as_forged(*document, s);

    lost.clear(); // neither opened nor discarded: offered again
    lost = lost_sessions(state, s.log);
    REQUIRE(lost.size() == 1);
    lost[0].discard();
    CHECK(lost_sessions(state, s.log).empty());
    CHECK(count_files(state) == 0);
    CHECK(s.log.warnings.empty());
}

TEST_CASE("an unedited session is recovered too, and several are, the youngest first") {
    Session s;
    const fs::path state = s.folder / "state";
    const auto left = [&](const std::string& file) {
        killed_after([&](const auto& ready) {
            Log log;
            Autosave autosave(state);
            Recipe recipe;
            recipe.mesh = s.mesh.string();
            recipe.file = file;
            autosave.commit(recipe, log);
            ready();
        });
    };
    left("");
    ::sleep(1); // times are in seconds
    left("/b.json");
    const std::vector<LostSession> lost = lost_sessions(state, s.log);
    REQUIRE(lost.size() == 2);
    CHECK(lost[0].recipe.file == "/b.json");
    CHECK(lost[1].recipe.file.empty());
    CHECK(lost[1].recipe.edits.empty());
}

TEST_CASE("a session that lives is not taken for a dead one, and one that ends leaves nothing") {
    Session s;
    const fs::path state = s.folder / "state";
    {
        Autosave autosave(state);
        CHECK(autosave.file().empty());
        autosave.commit(some_recipe(s.mesh), s.log);
        CHECK(fs::exists(autosave.file()));
        CHECK(lost_sessions(state, s.log).empty());
        autosave.forget();
        CHECK_FALSE(fs::exists(autosave.file()));
        CHECK(lost_sessions(state, s.log).empty());
        autosave.commit(some_recipe(s.mesh), s.log);
        CHECK(fs::exists(autosave.file()));
    }
    CHECK(count_files(state) == 0);
}

TEST_CASE("what is offered in mid-drag is written once an interval, and only if it changed") {
    Session s;
    const Autosave::Clock::time_point start = Autosave::Clock::now();
    const auto later = [&](double seconds) {
        return start + std::chrono::milliseconds(static_cast<int>(1000 * seconds));
    };
    Autosave autosave(s.folder / "state", std::chrono::seconds(3));
    Recipe recipe = some_recipe(s.mesh);
    const auto written_amount = [&] {
        const std::string text = read_file(autosave.file());
        return text.find("\"amount\": 0.25") != std::string::npos;
    };
    autosave.offer(recipe, s.log, later(10));
    recipe.edits[0].amount = 0.25;
    autosave.offer(recipe, s.log, later(12.9));
    CHECK_FALSE(written_amount());
    autosave.offer(recipe, s.log, later(13.1));
    CHECK(written_amount());
    fs::remove(autosave.file());
    autosave.offer(recipe, s.log, later(20));
    CHECK_FALSE(fs::exists(autosave.file()));
    recipe.edits[0].amount = 0.75;
    autosave.commit(recipe, s.log);
    CHECK(fs::exists(autosave.file()));
}

TEST_CASE("damaged sessions are put aside with a warning, once, and the others are offered") {
    Session s;
    const fs::path state = s.folder / "state";
    fs::create_directories(state);
    killed_after([&](const auto& ready) {
        Log log;
        Autosave autosave(state);
        autosave.commit(some_recipe(s.mesh), log);
        ready();
    });
    fs::path good;
    for (const auto& entry : fs::directory_iterator(state)) {
        good = entry.path().extension() == ".anvil-session" ? entry.path() : good;
    }
    const std::string text = read_file(good);
    const std::vector<std::string> damaged = {"", text.substr(0, text.size() / 2), "{\"anvil_session\": 2}",
                                              "\xff\xfe\x00", "[]"};
    for (size_t i = 0; i < damaged.size(); ++i) {
        write_file_atomically(state / ("bad" + std::to_string(i) + ".anvil-session"),
                              std::string_view(damaged[i]));
    }
    CHECK(lost_sessions(state, s.log).size() == 1);
    CHECK(s.log.warnings.size() == damaged.size());
    CHECK(lost_sessions(state, s.log).size() == 1);
    CHECK(s.log.warnings.size() == damaged.size());
    CHECK(fs::exists(state / "bad1.anvil-session.damaged"));
}

TEST_CASE("where nothing can be written a session goes on, and says once that it cannot be recovered") {
    Session s;
    write_file_atomically(s.folder / "file", std::string_view("not a folder"));
    Autosave autosave(s.folder / "file");
    Recipe recipe = some_recipe(s.mesh);
    autosave.commit(recipe, s.log);
    recipe.edits[0].amount = 0.5;
    autosave.commit(recipe, s.log);
    CHECK(s.log.warnings.size() == 1);
    CHECK(lost_sessions(s.folder / "file", s.log).empty());
    CHECK(lost_sessions(s.folder / "nowhere", s.log).empty());
    Autosave none(std::nullopt);
    none.commit(recipe, s.log);
    CHECK(s.log.warnings.size() == 1);
}
