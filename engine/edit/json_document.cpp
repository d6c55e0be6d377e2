#include "engine/edit/json_reader.h"

#include "engine/core/error.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace anvil {

namespace {

using nlohmann::json;

constexpr size_t max_depth = 100;

// Follows the parser: the library keeps the last of two equal keys silently and its errors name no path.
class Place {
  public:
    explicit Place(const std::string& file) : file_(file) {}

    bool follow(json::parse_event_t event, const json& parsed) {
        switch (event) {
        case json::parse_event_t::object_start:
        case json::parse_event_t::array_start:
            enter(event == json::parse_event_t::array_start);
            break;
        case json::parse_event_t::key:
            name(parsed.get_ref<const std::string&>());
            break;
        case json::parse_event_t::object_end:
        case json::parse_event_t::array_end:
            levels_.pop_back();
            advance();
            break;
        case json::parse_event_t::value:
            advance();
            break;
        }
        return true;
    }

    [[noreturn]] void fail(const std::string& message) const {
        std::string path;
        for (const Level& level : levels_) {
            path +=
                level.list ? "[" + std::to_string(level.index) + "]" : (path.empty() ? "" : ".") + level.key;
        }
        throw InputError(file_ + ": " + (path.empty() ? "" : path + ": ") + message);
    }

  private:
    struct Level {
        bool list = false;
        size_t index = 0;
        std::string key;
        std::set<std::string> seen;
    };

    void enter(bool list) {
        if (levels_.size() == max_depth) {
            throw InputError(file_ + ": nested deeper than " + std::to_string(max_depth) + " levels");
        }
        levels_.emplace_back().list = list;
    }

    void name(const std::string& key) {
        Level& level = levels_.back();
        level.key = key;
        if (!level.seen.insert(key).second) {
            fail("this key occurs twice in its object; remove one");
        }
    }

    void advance() {
        if (!levels_.empty() && levels_.back().list) {
            ++levels_.back().index;
        }
    }

    const std::string& file_;
    std::vector<Level> levels_;
};

[[noreturn]] void fail_syntax(const json::parse_error& error, const std::string& text,
                              const std::string& file) {
    const size_t end = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    const size_t newline = end > 0 ? text.rfind('\n', end - 1) : std::string::npos;
    const size_t column = end - (newline == std::string::npos ? 0 : newline + 1) + 1;
    std::string reason = error.what();
    if (const size_t at = reason.find(": "); at != std::string::npos) {
        reason.erase(0, at + 2);
    }
    constexpr size_t readable = 200;
    throw InputError(file + ": line " + std::to_string(line) + ", column " + std::to_string(column) +
                     ": not JSON: " + reason.substr(0, readable));
}

[[noreturn]] void fail_overflow(const std::string& reason, const Place& place) {
    const size_t begin = reason.find('\'');
    const size_t end = reason.rfind('\'');
    const bool quoted = begin != std::string::npos && end > begin;
    place.fail("found " + (quoted ? reason.substr(begin + 1, end - begin - 1) : reason) +
               "; must be a finite number (at most 1.7e308)");
}

} // namespace

json parse_json(const std::string& text, const std::string& file) {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
        throw InputError(file + ": the file is empty; a recipe begins with {\"anvil\": 1, ...}");
    }
    Place place(file);
    try {
        return json::parse(
            text, [&](int, json::parse_event_t event, json& parsed) { return place.follow(event, parsed); });
    } catch (const json::parse_error& error) {
        fail_syntax(error, text, file);
    } catch (const json::out_of_range& error) {
        fail_overflow(error.what(), place);
    }
}

} // namespace anvil
