#include "app/viewer/script_view.h"

#include "engine/core/error.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace anvil {

namespace {

/// Which of the names was given.
size_t choice(const ScriptLine& line, std::initializer_list<const char*> names) {
    const auto* found =
        std::find_if(names.begin(), names.end(), [&](const char* name) { return line.arguments[0] == name; });
    if (found == names.end()) {
        std::string all;
        for (const char* name : names) {
            all += std::string(all.empty() ? "" : ", ") + name;
        }
        throw InputError(line.word + " takes one of " + all + ", not \"" + line.arguments[0] + "\"");
    }
    return static_cast<size_t>(found - names.begin());
}

void set_mirror(const ScriptLine& line, Session& session) {
    const size_t axis = choice(line, {"x", "y", "z", "off"});
    session.editor.mirror.reset();
    if (axis < 3) {
        const double origin = line.arguments.size() > 1 ? script_number(line.arguments[1]) : 0;
        session.editor.mirror = Mirror{static_cast<int>(axis), origin, std::nullopt};
    }
    session.editor.settings_changed();
}

void change_selection(const ScriptLine& line, Session& session) {
    using Kind = SelectionChange::Kind;
    constexpr std::array kinds{Kind::all,    Kind::none,          Kind::invert,          Kind::grow,
                               Kind::shrink, Kind::hide_selected, Kind::hide_unselected, Kind::show_all};
    const size_t what = choice(line, {"all", "none", "invert", "grow", "shrink", "hide", "isolate", "show",
                                      "pin", "unpin", "anchor", "frame", "through", "visible"});
    switch (what) {
    case kinds.size():
        session.pin_selection();
        break;
    case kinds.size() + 1:
        session.editor.set_lasting_pins({});
        break;
    case kinds.size() + 2:
        session.anchor_selection();
        break;
    case kinds.size() + 3:
        session.frame_selection();
        break;
    case kinds.size() + 4:
    case kinds.size() + 5:
        session.select.through = what == kinds.size() + 4;
        break;
    default:
        session.change_selection(kinds.at(what));
    }
}

} // namespace

bool play_view_word(const ScriptLine& line, Session& session) {
    if (line.word == "up") {
        session.set_up(choice(line, {"y", "z"}) == 0 ? UpAxis::y : UpAxis::z);
    } else if (line.word == "light") {
        session.view.lights = light_names().at(choice(line, {"studio", "clay", "metal", "stripes"})).second;
    } else if (line.word == "edges") {
        session.view.edges = choice(line, {"on", "off"}) == 0;
    } else if (line.word == "flat") {
        session.view.flat = choice(line, {"on", "off"}) == 0;
    } else if (line.word == "motion") {
        session.view.less_in_motion = choice(line, {"coarse", "fine"}) == 0;
    } else if (line.word == "mirror") {
        set_mirror(line, session);
    } else if (line.word == "select") {
        change_selection(line, session);
    } else {
        return false;
    }
    return true;
}

std::optional<std::string> view_value(const std::string& name, const Session& session) {
    const Editor& editor = session.editor;
    if (name == "selected") {
        return std::to_string(session.shown().look->selected_count);
    }
    if (name == "hidden") {
        return std::to_string(session.shown().look->hidden_count);
    }
    if (name == "pins") {
        return std::to_string(editor.pins().size() + editor.lasting_pins().size());
    }
    if (name == "anchors") {
        size_t count = 0;
        for (const PickedHandle& handle : editor.handles()) {
            count += handle.anchors.size() + handle.anchor_faces.size() + handle.anchor_lines.size();
        }
        return std::to_string(count);
    }
    return std::nullopt;
}

} // namespace anvil
