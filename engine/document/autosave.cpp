#include "engine/document/autosave.h"

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/read_file.h"
#include "engine/edit/json_reader.h"
#include "engine/edit/recipe_json.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <random>

namespace anvil {

namespace fs = std::filesystem;

namespace {

constexpr const char* suffix = ".anvil-session";
constexpr const char* lock_suffix = ".anvil-lock";

std::string now_as_text() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    const size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return {text.data(), size};
}

std::string random_name() {
    std::random_device device;
    std::string name;
    for (int i = 0; i < 16; ++i) {
        name += "0123456789abcdef"[device() % 16];
    }
    return name;
}

std::string session_text(const Recipe& recipe) {
    nlohmann::ordered_json session{{"anvil_session", 1}, {"time", now_as_text()}, {"file", recipe.file}};
    session["recipe"] = nlohmann::ordered_json::parse(write_recipe(recipe));
    return session.dump(2) + "\n";
}

/// @throws InputError if it is damaged.
LostSession read_session(const fs::path& file) {
    const std::string name = file.string();
    const nlohmann::json document = parse_json(read_file(file), name);
    const JsonReader root(document, name);
    root.check_keys({"anvil_session", "time", "file", "recipe"});
    if (const JsonReader version = root.required("anvil_session"); version.number() != 1) {
        version.fail_found("this program reads sessions of version 1");
    }
    LostSession session;
    root.required("recipe");
    session.recipe = parse_recipe(document.at("recipe").dump(), name);
    session.recipe.file = root.required("file").text();
    session.time = root.required("time").text();
    session.file = file;
    return session;
}

fs::path lock_of(const fs::path& session) {
    return fs::path(session).replace_extension(lock_suffix);
}

void remove_both(const fs::path& session) {
    std::error_code ignored;
    fs::remove(session, ignored);
    fs::remove(lock_of(session), ignored);
}

/// Nothing if its program runs, or another one offers it.
std::optional<FileLock> lock_of_dead(const fs::path& session) {
    const fs::path lock = lock_of(session);
    std::error_code unknown;
    return fs::exists(lock, unknown) ? FileLock::take_over(lock) : FileLock::make(lock);
}

/// A damaged one is put aside, so that it is complained of once.
void read_into(std::vector<LostSession>& sessions, const fs::path& file, FileLock lock, Log& log) {
    try {
        LostSession session = read_session(file);
        session.lock = std::move(lock);
        sessions.push_back(std::move(session));
    } catch (const InputError& error) {
        const fs::path aside = file.string() + ".damaged";
        std::error_code failed;
        fs::rename(file, aside, failed);
        fs::remove(lock_of(file), failed);
        log.warn("a session cannot be recovered: " + std::string(error.what()) + "; it is kept as " +
                 aside.string());
    }
}

} // namespace

Autosave::Autosave(std::optional<fs::path> folder, Clock::duration interval)
    : folder_(std::move(folder)), interval_(interval) {}

Autosave::~Autosave() {
    if (lock_) {
        remove_both(file_);
    }
}

/// The lock is there before the file, and held: nobody takes this session for a dead one.
bool Autosave::begin(Log& log) {
    if (lock_ || !folder_) {
        return lock_.has_value();
    }
    std::error_code ignored;
    fs::create_directories(*folder_, ignored);
    const fs::path file = *folder_ / (random_name() + suffix);
    lock_ = FileLock::make(lock_of(file));
    if (!lock_) {
        complain(log, folder_->string() + ": no file can be made and locked here");
        return false;
    }
    file_ = file;
    return true;
}

void Autosave::complain(Log& log, const std::string& reason) {
    if (!complained_) {
        complained_ = true;
        log.warn(reason + "; this session cannot be recovered if the program ends unexpectedly");
    }
}

void Autosave::write(const Recipe& recipe, Log& log) {
    if (written_ == recipe || !begin(log)) {
        return;
    }
    try {
        write_file_atomically(file_, session_text(recipe));
        written_ = recipe;
    } catch (const WriteError& error) {
        complain(log, error.what());
    }
}

void Autosave::commit(const Recipe& recipe, Log& log) {
    write(recipe, log);
    written_at_ = Clock::now();
}

void Autosave::offer(const Recipe& recipe, Log& log, Clock::time_point now) {
    if (now - written_at_ >= interval_) {
        write(recipe, log);
        written_at_ = now;
    }
}

void Autosave::forget() {
    std::error_code ignored;
    if (lock_) {
        fs::remove(file_, ignored);
    }
    written_.reset();
}

void LostSession::discard() {
    remove_both(file);
    lock.reset();
}

std::vector<LostSession> lost_sessions(const std::optional<fs::path>& folder, Log& log) {
    std::vector<LostSession> sessions;
    std::error_code failed;
    if (!folder) {
        return sessions;
    }
    for (auto entry = fs::directory_iterator(*folder, failed); !failed && entry != fs::directory_iterator();
         entry.increment(failed)) {
        const fs::path& file = entry->path();
        if (file.extension() == lock_suffix) {
            // Of a session that died before it wrote, or after all was saved.
            const fs::path session = fs::path(file).replace_extension(suffix);
            std::error_code unknown;
            if (auto lock = FileLock::take_over(file); lock && !fs::exists(session, unknown)) {
                fs::remove(file, unknown);
            }
        }
        if (file.extension() != suffix) {
            continue;
        }
        if (std::optional<FileLock> lock = lock_of_dead(file)) {
            read_into(sessions, file, std::move(*lock), log);
        }
    }
    std::sort(sessions.begin(), sessions.end(),
              [](const LostSession& a, const LostSession& b) { return a.time > b.time; });
    return sessions;
}

} // namespace anvil
