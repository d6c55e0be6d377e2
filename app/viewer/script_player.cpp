#include "app/viewer/script_player.h"

#include "app/viewer/script_edits.h"
#include "app/viewer/script_occluders.h"
#include "app/viewer/script_view.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/gpu/picture.h"

#include <algorithm>
#include <csignal>
#include <iostream>

namespace anvil {

namespace {

constexpr int drag_frames = 8;
const std::string gizmo_word = "@gizmo.";

MouseButton button_of(const std::string& name) {
    if (name == "left" || name == "middle" || name == "right") {
        return name == "left"     ? MouseButton::left
               : name == "middle" ? MouseButton::middle
                                  : MouseButton::right;
    }
    throw InputError("there is no button \"" + name + "\"; there are left, middle and right");
}

/// Whether something touches an occluder: in the drag, under one that is moved, after the last edit.
std::string touching_of(const Shown& shown) {
    const bool touches = shown.drag       ? shown.drag->contact && shown.drag->contact->touching.vertices > 0
                         : shown.standing ? shown.standing->vertices > 0
                                          : shown.document.surface->report.contact &&
                                                shown.document.surface->report.contact->contact_vertices > 0;
    return touches ? "yes" : "no";
}

} // namespace

ScriptPlayer::ScriptPlayer(const std::filesystem::path& file)
    : file_(file.string()), lines_(read_script(file)) {}

std::vector<InputEvent> ScriptPlayer::next(Session& session, Window& window, FrameLog& frames) {
    if (!events_.empty()) {
        const InputEvent event = events_.front();
        events_.pop_front();
        return {event};
    }
    if (std::chrono::steady_clock::now() < awake_at_) {
        return {};
    }
    if (waiting_) {
        // Twice: what the first frame after the work asks for is work again.
        settled_frames_ = session.settled() ? settled_frames_ + 1 : 0;
        waiting_ = settled_frames_ < 2;
        return {};
    }
    while (next_ < lines_.size()) {
        const ScriptLine& line = lines_[next_++];
        try {
            if (play(line, session, window, frames)) {
                return {};
            }
        } catch (const InputError& error) {
            std::string text = file_ + ":" + std::to_string(line.number) + ": " + error.what();
            for (const Notice& notice : session.notices()) {
                text += "; the window says: " + notice.text;
            }
            throw InputError(text);
        }
    }
    return {};
}

/// Whether a frame is to be drawn before the next line.
bool ScriptPlayer::play(const ScriptLine& line, Session& session, Window& window, FrameLog& frames) {
    const std::vector<std::string>& with = line.arguments;
    if (line.word == "wait") {
        waiting_ = true;
        settled_frames_ = 0;
    } else if (line.word == "sleep") {
        awake_at_ = std::chrono::steady_clock::now() +
                    std::chrono::milliseconds(static_cast<int64_t>(1000 * script_number(with[0])));
    } else if (line.word == "screenshot") {
        pictures_.push_back(with[0]);
    } else if (line.word == "move") {
        move_to(line, session);
    } else if (line.word == "press") {
        add_mouse(InputEvent::Kind::press, with);
    } else if (line.word == "release") {
        add_mouse(InputEvent::Kind::release, with);
    } else if (line.word == "click") {
        add_mouse(InputEvent::Kind::press, with);
        add_mouse(InputEvent::Kind::release, with);
    } else if (line.word == "drag") {
        add_drag(line);
    } else if (line.word == "hold") {
        const auto has = [&](const char* name) {
            return std::find(with.begin(), with.end(), name) != with.end();
        };
        held_ = {has("shift"), has("ctrl"), has("alt")};
        return false;
    } else if (line.word == "key") {
        events_.push_back(key_event(with[0], true));
        events_.push_back(key_event(with[0], false));
    } else if (line.word == "type") {
        for (const char c : with[0]) {
            InputEvent event;
            event.kind = InputEvent::Kind::text;
            event.character = static_cast<unsigned char>(c);
            events_.push_back(event);
        }
    } else if (line.word == "drop") {
        InputEvent event;
        event.kind = InputEvent::Kind::drop;
        event.files = with;
        events_.push_back(event);
    } else if (line.word == "scroll") {
        InputEvent event;
        event.kind = InputEvent::Kind::scroll;
        event.y = script_number(with[0]);
        event.modifiers = held_;
        events_.push_back(event);
    } else {
        act(line, session, window, frames);
    }
    return true;
}

void ScriptPlayer::act(const ScriptLine& line, Session& session, Window& window, FrameLog& frames) {
    const std::vector<std::string>& with = line.arguments;
    if (play_occluder_line(line, session) || play_edit_line(line, session)) {
        return;
    }
    if (line.word == "window") {
        window.resize({static_cast<int>(script_number(with[0])), static_cast<int>(script_number(with[1]))});
    } else if (line.word == "minimize") {
        window.minimize(with[0] == "on");
    } else if (line.word == "open") {
        session.open(with[0]);
    } else if (line.word == "recover") {
        session.recover();
    } else if (line.word == "die") {
        std::raise(SIGKILL); // as a fault or a failing machine would end it
    } else if (line.word == "save") {
        session.save(with[0]);
    } else if (line.word == "view") {
        const Vec3 direction = parse_view(with[0]).direction;
        const bool named = with[0].find(',') == std::string::npos;
        session.look_from(named ? session.camera.side(direction) : direction);
    } else if (line.word == "frame") {
        session.frame_all();
    } else if (line.word == "device") {
        session.use_device(with[0]);
    } else if (line.word == "radius") {
        session.editor.radius = script_number(with[0]);
        session.editor.settings_changed();
    } else if (line.word == "shape") {
        session.editor.shape = {with[0], {}};
        make_shape_function(session.editor.shape); // an unknown one is the script's error
        session.editor.settings_changed();
    } else if (line.word == "metric") {
        session.editor.metric = with[0] == "euclidean" ? Metric::euclidean : Metric::geodesic;
        session.editor.settings_changed();
    } else if (line.word == "amount") {
        Recipe next = script_recipe(session);
        const double number = script_number(with[0]);
        if (!(number >= 0 && number < static_cast<double>(next.edits.size()))) {
            throw InputError("there is no edit " + with[0]);
        }
        next.edits[static_cast<size_t>(number)].amount = script_number(with[1]);
        session.change(next, "change of an edit", "edit " + with[0]);
    } else if (line.word == "expect") {
        expect(line, session);
    } else if (line.word == "found") {
        if (!session.missing_mesh()) {
            throw InputError("no mesh is missing");
        }
        session.take_missing_mesh(with[0]);
    } else if (line.word == "lose") {
        if (with[0] == "computing") {
            session.lose_computing();
        } else if (with[0] == "drawing" || with[0] == "surface") {
            loses_ = with[0] == "drawing" ? Loss::drawing : Loss::surface;
        } else {
            throw InputError("write: lose computing, lose drawing or lose surface");
        }
    } else if (line.word == "frames") {
        std::cout << with[0] << ": " << frames.report() << std::endl;
    } else if (play_view_word(line, session)) {
        return;
    } else if (line.word == "say") {
        std::cout << with[0] << std::endl; // read by whoever waits for it: not kept in a buffer
    }
}

void ScriptPlayer::expect(const ScriptLine& line, Session& session) const {
    const std::vector<std::string>& with = line.arguments;
    const Shown& shown = session.shown();
    std::string found = "nothing is open";
    if (with[0] == "handles") {
        found = std::to_string(session.editor.handles().size());
    } else if (with[0] == "notices") {
        found = std::to_string(session.notices().size());
    } else if (const auto value = view_value(with[0], session)) {
        found = *value;
    } else if (const auto of_edit = found_of_edit(with[0], session)) {
        found = *of_edit;
    } else if (shown.mesh) {
        const Recipe& recipe = *shown.document.recipe;
        found = with[0] == "edits"       ? std::to_string(recipe.edits.size())
                : with[0] == "occluders" ? std::to_string(recipe.occluders.size())
                : with[0] == "vertices"  ? std::to_string(shown.document.surface->mesh->vertex_count())
                : with[0] == "moved"     ? std::to_string(std::count(shown.document.surface->moved.begin(),
                                                                     shown.document.surface->moved.end(), true))
                : with[0] == "undo"      ? shown.document.undo
                : with[0] == "redo"      ? shown.document.redo
                : with[0] == "unsaved"   ? (shown.document.unsaved ? "yes" : "no")
                : with[0] == "device"    ? shown.device
                : with[0] == "touching"  ? touching_of(shown)
                : with[0] == "gizmo"     ? session.occluders.selected()
                                         : "nothing of that name";
    }
    if (found != with[1]) {
        throw InputError("expected " + with[0] + " " + with[1] + ", found " + found);
    }
}

void ScriptPlayer::add_mouse(InputEvent::Kind kind, const std::vector<std::string>& arguments) {
    InputEvent event;
    event.kind = kind;
    event.button = button_of(arguments.empty() ? "left" : arguments[0]);
    event.modifiers = held_;
    events_.push_back(event);
}

void ScriptPlayer::add_move(double x, double y) {
    x_ = x;
    y_ = y;
    InputEvent event;
    event.kind = InputEvent::Kind::move;
    event.x = x;
    event.y = y;
    event.modifiers = held_;
    events_.push_back(event);
}

void ScriptPlayer::add_drag(const ScriptLine& line) {
    const std::vector<std::string>& with = line.arguments;
    const std::vector<std::string> button(with.begin() + 2, with.end());
    const double dx = script_number(with[0]);
    const double dy = script_number(with[1]);
    const double x = x_;
    const double y = y_;
    add_mouse(InputEvent::Kind::press, button);
    for (int i = 1; i <= drag_frames; ++i) {
        add_move(x + dx * i / drag_frames, y + dy * i / drag_frames);
    }
    add_mouse(InputEvent::Kind::release, button);
}

void ScriptPlayer::move_to(const ScriptLine& line, const Session& session) {
    const std::vector<std::string>& with = line.arguments;
    if (!with[0].starts_with('@')) {
        if (with.size() != 2) {
            throw InputError("write: move X Y, move @ADDRESS [DX DY], or move @gizmo.MARK [DX DY]");
        }
        add_move(script_number(with[0]), script_number(with[1]));
        return;
    }
    const double dx = with.size() == 3 ? script_number(with[1]) : 0;
    const double dy = with.size() == 3 ? script_number(with[2]) : 0;
    if (with[0].starts_with(gizmo_word)) {
        const glm::dvec2 mark = gizmo_place(session, with[0].substr(gizmo_word.size()));
        add_move(mark.x + dx, mark.y + dy);
        return;
    }
    const PickSurface* surface = session.shown().pick.get();
    const auto place =
        surface != nullptr ? surface->position(parse_address(with[0].substr(1))) : std::nullopt;
    if (!place) {
        throw InputError("there is no surface point " + with[0].substr(1));
    }
    const ScreenPoint at = session.camera.project(*place);
    if (!at.visible()) {
        throw InputError("the point " + with[0].substr(1) + " is behind the eye");
    }
    add_move(at.x + dx, at.y + dy);
}

} // namespace anvil
