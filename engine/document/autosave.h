// The recipe of a session on disk while the session lives, and what sessions that died have left.
#pragma once

#include "engine/core/file_lock.h"
#include "engine/core/log.h"
#include "engine/edit/recipe.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// One file for one session. It never fails: where it cannot be written, the log hears so once.
class Autosave {
  public:
    using Clock = std::chrono::steady_clock;

    /// In the folder (nothing is kept where there is none), from the first recipe on.
    explicit Autosave(std::optional<std::filesystem::path> folder,
                      Clock::duration interval = std::chrono::seconds(3));
    /// The session ended well, or by an exception that was caught: nothing is left.
    ~Autosave();
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// The recipe after a step, its paths absolute, and its file (Recipe::file, empty: none): written now.
    void commit(const Recipe& recipe, Log& log);
    /// The recipe in the middle of something: written if the last one is older than the interval. `now` is
    /// not less than in earlier calls.
    void offer(const Recipe& recipe, Log& log, Clock::time_point now = Clock::now());
    /// All is saved elsewhere: what was written is removed until there is something new.
    void forget();

    const std::filesystem::path& file() const { return file_; } ///< empty before the first one

  private:
    bool begin(Log& log);
    void write(const Recipe& recipe, Log& log);
    void complain(Log& log, const std::string& reason);

    std::optional<std::filesystem::path> folder_;
    Clock::duration interval_;
    std::filesystem::path file_, lock_file_;
    std::optional<FileLock> lock_;
    std::optional<Recipe> written_;
    Clock::time_point written_at_;
    bool complained_ = false;
};

/// What a session that died has left. It is this program's until it ends or lets go of it; other programs do
/// not see it meanwhile.
struct LostSession {
    Recipe recipe;              ///< paths absolute; Recipe::file: where it was read from or saved to
    std::string time;           ///< when it was written: UTC, 2026-11-22T19:39:05Z
    std::filesystem::path file; ///< that holds it
    std::optional<FileLock> lock;

    /// Removes it: it was opened and saved, or is not wanted. Else the next start offers it again.
    void discard();
};

/// Those in the folder, the youngest first. Damaged ones are put aside, with a warning.
std::vector<LostSession> lost_sessions(const std::optional<std::filesystem::path>& folder, Log& log);

} // namespace anvil
