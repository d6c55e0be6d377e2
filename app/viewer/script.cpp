#include "app/viewer/script.h"

#include "app/viewer/window.h"
#include "engine/core/error.h"
#include "engine/edit/surface_address.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <utility>

namespace anvil {

namespace {

struct Word {
    const char* name;
    size_t least;
    size_t most;
};

constexpr std::array words{
    Word{"window", 2, 2},   Word{"open", 1, 1},    Word{"view", 1, 1},    Word{"frame", 0, 0},
    Word{"move", 1, 3},     Word{"press", 0, 1},   Word{"release", 0, 1}, Word{"click", 0, 1},
    Word{"drag", 2, 3},     Word{"hold", 0, 3},    Word{"key", 1, 1},     Word{"type", 1, 1},
    Word{"scroll", 1, 1},   Word{"wait", 0, 0},    Word{"sleep", 1, 1},   Word{"screenshot", 1, 1},
    Word{"save", 1, 1},     Word{"device", 1, 1},  Word{"radius", 1, 1},  Word{"shape", 1, 1},
    Word{"occluder", 2, 9}, Word{"expect", 2, 3},  Word{"refine", 1, 5},  Word{"amount", 2, 2},
    Word{"say", 1, 1},      Word{"recover", 0, 0}, Word{"die", 0, 0},     Word{"metric", 1, 1},
    Word{"up", 1, 1},       Word{"light", 1, 1},   Word{"mirror", 1, 2},  Word{"edges", 1, 1},
    Word{"flat", 1, 1},     Word{"select", 1, 1},  Word{"motion", 1, 1},  Word{"dilation", 1, 3},
    Word{"hammer", 1, 1},   Word{"frames", 1, 1},  Word{"found", 1, 1},   Word{"lose", 1, 1},
    Word{"edit", 2, 9},     Word{"path", 1, 1},    Word{"curve", 2, 2},   Word{"drop", 1, 9},
    Word{"minimize", 1, 1},
};

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> parts;
    std::string part;
    bool quoted = false;
    bool any = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
            any = true;
        } else if ((c == ' ' || c == '\t' || c == '\r') && !quoted) {
            if (any || !part.empty()) {
                parts.push_back(std::exchange(part, {}));
            }
            any = false;
        } else {
            part += c;
        }
    }
    if (any || !part.empty()) {
        parts.push_back(part);
    }
    return parts;
}

const Word& known_word(const std::string& name, const std::string& place) {
    const auto* found =
        std::find_if(words.begin(), words.end(), [&](const Word& w) { return name == w.name; });
    if (found != words.end()) {
        return *found;
    }
    std::string all;
    for (const Word& word : words) {
        all += std::string(all.empty() ? "" : ", ") + word.name;
    }
    throw InputError(place + ": there is no command \"" + name + "\"; there are " + all);
}

ScriptLine parsed(const std::vector<std::string>& parts, size_t number, const std::string& place) {
    const Word& word = known_word(parts[0], place);
    ScriptLine line{number, parts[0], {parts.begin() + 1, parts.end()}};
    if (line.arguments.size() < word.least || line.arguments.size() > word.most) {
        throw InputError(place + ": " + parts[0] + " takes " + std::to_string(word.least) +
                         (word.most > word.least ? " to " + std::to_string(word.most) : "") +
                         " arguments, it has " + std::to_string(line.arguments.size()));
    }
    return line;
}

} // namespace

std::vector<ScriptLine> read_script(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) {
        throw InputError(file.string() + ": cannot be read; is the path right?");
    }
    std::vector<ScriptLine> lines;
    std::string text;
    for (size_t number = 1; std::getline(stream, text); ++number) {
        const std::vector<std::string> parts = split(text);
        if (!parts.empty() && !parts[0].starts_with('#')) {
            lines.push_back(parsed(parts, number, file.string() + ":" + std::to_string(number)));
        }
    }
    return lines;
}

InputEvent key_event(const std::string& text, bool down) {
    InputEvent event;
    event.kind = down ? InputEvent::Kind::key_down : InputEvent::Kind::key_up;
    std::string rest = text;
    const auto take = [&](const std::string& name, bool& held) {
        if (rest.size() > name.size() && rest.starts_with(name)) {
            held = true;
            rest = rest.substr(name.size());
        }
    };
    for (int i = 0; i < 3; ++i) {
        take("ctrl+", event.modifiers.control);
        take("shift+", event.modifiers.shift);
        take("alt+", event.modifiers.alt);
    }
    event.key = key_of(rest);
    if (event.key == 0) {
        throw InputError("there is no key \"" + rest +
                         "\"; keys are a to z, 0 to 9, F1 to F12, escape, enter, "
                         "tab, backspace, delete, left, right, up, down, home, end, space");
    }
    return event;
}

double script_number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw InputError("\"" + text + "\" is no number");
    }
    return value;
}

Vec3 script_point(const std::string& text) {
    const SurfaceAddress address = parse_address(text);
    if (const auto* near = std::get_if<NearestAddress>(&address)) {
        return near->point;
    }
    throw InputError("\"" + text + "\" is no point; write x,y,z");
}

} // namespace anvil
