#include "app/viewer/script_occluders.h"

#include "app/viewer/panels/occluder_panel.h"
#include "app/viewer/script_edits.h"
#include "engine/core/error.h"

#include <algorithm>
#include <array>

namespace anvil {

namespace {

void need(bool right, const std::string& form) {
    if (!right) {
        throw InputError("write: " + form);
    }
}

GizmoPart part_of(const std::string& name) {
    if (name == "free" || name == "turn" || name == "scale") {
        return {name == "free"   ? GizmoAction::move_freely
                : name == "turn" ? GizmoAction::turn_in_view
                                 : GizmoAction::scale,
                0};
    }
    const std::array<std::pair<const char*, GizmoAction>, 3> actions{
        {{"move-", GizmoAction::move}, {"plane-", GizmoAction::across}, {"turn-", GizmoAction::turn}}};
    for (const auto& [begin, action] : actions) {
        const std::string start = begin;
        if (name.starts_with(start) && name.size() == start.size() + 1 && name.back() >= 'x' &&
            name.back() <= 'z') {
            return {action, name.back() - 'x'};
        }
    }
    throw InputError("the gizmo has no mark \"" + name +
                     "\"; it has free, move-x, plane-x, turn-x (also y, z), turn and scale");
}

Influence influence_of(const std::vector<std::string>& with) {
    Influence influence;
    const std::string& kind = with[2];
    if (kind == "curve") {
        need(with.size() == 5, "occluder influence NAME curve WIDTH SHAPE");
        const ShapeChoice shape = with_own_knots(script_shape(with[4]));
        return {InfluenceKind::curve, influence.strength, {}, shape.knots, script_number(with[3])};
    }
    need(kind == "soft" || kind == "hard" || kind == "paper",
         "occluder influence NAME soft [STRENGTH [SIGMA]] | hard | paper | curve WIDTH SHAPE");
    influence.kind = kind == "soft"   ? InfluenceKind::soft
                     : kind == "hard" ? InfluenceKind::hard
                                      : InfluenceKind::paper;
    if (with.size() > 3) {
        influence.strength = script_number(with[3]);
    }
    if (with.size() > 4) {
        influence.sigma = script_number(with[4]);
    }
    return influence;
}

void add_occluder_of(const std::vector<std::string>& with, Session& session) {
    need(with.size() == 5, "occluder add NAME SHAPE SIZE X,Y,Z");
    Recipe next = script_recipe(session);
    Occluder occluder;
    occluder.name = with[1];
    occluder.shape = occluder_shape(with[2], script_number(with[3]));
    occluder.transform.translate = script_point(with[4]);
    next.occluders.push_back(occluder);
    session.change(next, "new occluder");
}

/// What changes the recipe. Whether it was one of these.
bool change_occluder(const std::vector<std::string>& with, Session& session) {
    Recipe next = script_recipe(session);
    const auto found = std::find_if(next.occluders.begin(), next.occluders.end(),
                                    [&](const Occluder& o) { return o.name == with[1]; });
    if (found == next.occluders.end()) {
        throw InputError("there is no occluder \"" + with[1] + "\"");
    }
    std::string what = "occluder's place";
    if (with[0] == "move") {
        need(with.size() == 3, "occluder move NAME X,Y,Z");
        found->transform.translate = script_point(with[2]);
    } else if (with[0] == "turn") {
        need(with.size() == 4, "occluder turn NAME X,Y,Z DEGREES");
        found->transform.axis = script_point(with[2]);
        found->transform.degrees = script_number(with[3]);
    } else if (with[0] == "scale") {
        need(with.size() == 3, "occluder scale NAME FACTOR");
        found->transform.scale = script_number(with[2]);
    } else if (with[0] == "influence") {
        need(with.size() >= 3, "occluder influence NAME KIND ...");
        found->influence = influence_of(with);
        what = "occluder's influence";
    } else if (with[0] == "remove") {
        next.occluders.erase(found);
        what = "removal of an occluder";
    } else {
        return false;
    }
    session.change(next, what);
    return true;
}

void play_occluder(const std::vector<std::string>& with, Session& session) {
    if (with[0] == "add") {
        add_occluder_of(with, session);
    } else if (with[0] == "select") {
        session.occluders.select(with[1]);
    } else if (with[0] == "record") {
        session.occluders.records = with[1] == "on";
    } else if (with[0] == "on" || with[0] == "off") {
        session.switch_occluder(with[1], with[0] == "on");
    } else if (!change_occluder(with, session)) {
        throw InputError("write: occluder add, move, turn, scale, influence, remove, select, on, off or "
                         "record");
    }
}

void play_dilation(const std::vector<std::string>& with, Session& session) {
    std::optional<Dilation> dilation;
    if (with[0] != "off") {
        need(with[0] == "depth" || with[0] == "volume" || with[0] == "solve",
             "dilation depth|volume AMOUNT [WIDTH] | solve [WIDTH] | off");
        dilation.emplace();
        dilation->form = with[0] == "depth" ? DilationForm::depth : DilationForm::volume;
        dilation->solve = with[0] == "solve";
        size_t next = 1;
        if (!dilation->solve && with.size() > next) {
            dilation->amount = script_number(with[next++]);
        }
        if (with.size() > next) {
            dilation->width = script_number(with[next]);
        }
    }
    session.options.dilation = dilation;
    session.options_changed();
}

} // namespace

Recipe script_recipe(const Session& session) {
    if (!session.shown().document.recipe) {
        throw InputError("nothing is open");
    }
    return *session.shown().document.recipe;
}

bool play_occluder_line(const ScriptLine& line, Session& session) {
    if (line.word == "occluder") {
        play_occluder(line.arguments, session);
    } else if (line.word == "dilation") {
        play_dilation(line.arguments, session);
    } else if (line.word == "hammer") {
        need(line.arguments[0] == "near" || line.arguments[0] == "everywhere", "hammer near | everywhere");
        session.options.near_strike = line.arguments[0] == "near";
        session.options_changed();
    } else {
        return false;
    }
    return true;
}

glm::dvec2 gizmo_place(const Session& session, const std::string& part) {
    const GizmoPart wanted = part_of(part);
    const std::vector<GizmoMark> marks = session.occluders.marks(session.camera, session.shown().occluders);
    for (const GizmoMark& mark : marks) {
        if (!(mark.part == wanted)) {
            continue;
        }
        glm::dvec2 middle(0);
        for (const glm::dvec2& place : mark.line) {
            middle += place / static_cast<double>(mark.line.size());
        }
        std::vector<glm::dvec2> places = mark.line;
        places.insert(places.begin(), middle);
        for (const glm::dvec2& place : places) {
            if (gizmo_part_at(marks, place.x, place.y) == wanted) {
                return place;
            }
        }
    }
    throw InputError("the mark " + part + " cannot be grabbed from here; is an occluder selected?");
}

} // namespace anvil
