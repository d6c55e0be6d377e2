#include "app/viewer/script_edits.h"

#include "app/viewer/panels/curve_files.h"
#include "app/viewer/script_occluders.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/edit/shape_file.h"

#include <algorithm>

namespace anvil {

namespace {

using Words = std::vector<std::string>;

void need(bool right, const std::string& form) {
    if (!right) {
        throw InputError("write: " + form);
    }
}

/// `off`, a tolerance, or `shape T`, `space T`, `both T T`; then `flip` and `relax`.
std::optional<Refine> refine_of(const Words& with) {
    if (with[0] == "off") {
        return std::nullopt;
    }
    Refine refine;
    size_t next = 1;
    const auto number = [&] {
        need(next < with.size(), "refine TOLERANCE | shape T | space T | both T T | off, then flip, relax");
        return script_number(with[next++]);
    };
    if (with[0] == "space") {
        refine.criterion = RefineCriterion::space;
        refine.space_tolerance = number();
    } else if (with[0] == "both") {
        refine.criterion = RefineCriterion::both;
        refine.shape_tolerance = number();
        refine.space_tolerance = number();
    } else {
        refine.shape_tolerance = with[0] == "shape" ? number() : script_number(with[0]);
    }
    for (; next < with.size(); ++next) {
        need(with[next] == "flip" || with[next] == "relax", "refine ... flip relax");
        (with[next] == "flip" ? refine.flip : refine.relax) = true;
    }
    return refine;
}

/// `edit N handle H by X,Y,Z`, or `degrees D`.
void change_handle(const Words& with, Edit& edit) {
    need(with.size() == 5, "edit N handle H by X,Y,Z | edit N handle H degrees D");
    const double number = script_number(with[2]);
    need(number >= 0 && number < static_cast<double>(edit.handles.size()), "a handle that the edit has");
    Handle& handle = edit.handles[static_cast<size_t>(number)];
    if (with[3] == "degrees") {
        handle.degrees = script_number(with[4]);
    } else {
        need(with[3] == "by", "edit N handle H by X,Y,Z");
        handle.path.clear();
        handle.to.reset();
        handle.by = script_point(with[4]);
    }
}

void change_edit(const Words& with, Edit& edit) {
    const std::string& key = with[1];
    need(with.size() > 2, "edit N KEY VALUE");
    if (key == "radius") {
        edit.radius = script_number(with[2]);
    } else if (key == "amount") {
        edit.amount = script_number(with[2]);
    } else if (key == "shape") {
        edit.shape = script_shape(with[2]);
    } else if (key == "metric") {
        edit.metric = with[2] == "euclidean" ? Metric::euclidean : Metric::geodesic;
    } else if (key == "refine") {
        edit.refine = refine_of({with.begin() + 2, with.end()});
    } else if (key == "handle") {
        change_handle(with, edit);
    } else if (key == "without") {
        need(edit.occluders.has_value(), "an occluder that the edit has");
        std::erase_if(*edit.occluders, [&](const OccluderUse& use) { return use.name == with[2]; });
    } else {
        throw InputError("an edit's radius, amount, shape, metric, refine and handle can be changed, and it "
                         "can do without an occluder; it can be removed, and go up and down");
    }
}

void play_edit(const Words& with, Session& session) {
    Recipe next = script_recipe(session);
    const double number = script_number(with[0]);
    if (!(number >= 0 && number < static_cast<double>(next.edits.size()))) {
        throw InputError("there is no edit " + with[0]);
    }
    const auto place = next.edits.begin() + static_cast<std::ptrdiff_t>(number);
    if (with[1] == "remove") {
        next.edits.erase(place);
        session.change(next, "removal of an edit");
    } else if (with[1] == "up" || with[1] == "down") {
        const bool up = with[1] == "up";
        need(up ? place != next.edits.begin() : place + 1 != next.edits.end(), "a place in the list");
        std::iter_swap(place, up ? place - 1 : place + 1);
        session.change(next, "order of edits");
    } else {
        change_edit(with, *place);
        session.change(next, "change of an edit", "edit " + with[0]);
    }
}

void play_curve(const Words& with, Session& session) {
    need(with.size() == 2 && (with[0] == "load" || with[0] == "save"), "curve load|save NAME|FILE.json");
    const std::filesystem::path file = curve_file(with[1], curve_folder());
    if (with[0] == "save") {
        save_curve(session.editor.shape, file);
        return;
    }
    session.editor.shape = read_shape_file(file);
    session.options_changed();
}

} // namespace

ShapeChoice script_shape(const std::string& name) {
    const std::vector<std::string> presets = preset_names();
    if (std::find(presets.begin(), presets.end(), name) != presets.end()) {
        return {name, {}};
    }
    return read_shape_file(curve_file(name, curve_folder()));
}

bool play_edit_line(const ScriptLine& line, Session& session) {
    const Words& with = line.arguments;
    if (line.word == "edit") {
        play_edit(with, session);
    } else if (line.word == "refine") {
        session.editor.refine = refine_of(with);
        session.options_changed();
    } else if (line.word == "path") {
        need(with[0] == "on" || with[0] == "off", "path on | off");
        session.editor.follow_path = with[0] == "on";
    } else if (line.word == "curve") {
        play_curve(with, session);
    } else {
        return false;
    }
    return true;
}

std::optional<std::string> found_of_edit(const std::string& what, const Session& session) {
    if (what == "pending") {
        return session.has_pending() ? "yes" : "no";
    }
    if (what == "added") { // by the edit under way if it were taken, else by the last one
        const Shown& shown = session.shown();
        const EditReport* report = shown.outcome            ? &shown.outcome->report
                                   : shown.document.surface ? &shown.document.surface->report
                                                            : nullptr;
        return std::to_string(report != nullptr && report->refine ? report->refine->added : 0);
    }
    return std::nullopt;
}

} // namespace anvil
