#include "app/viewer/session.h"
#include "app/viewer/window.h"
#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

namespace {

const std::string ahead = "looking ahead";
constexpr std::chrono::milliseconds rest_before_outcome(250);

} // namespace

bool Session::has_pending() const {
    return editor.has_handles() || occluders.has_motion();
}

void Session::switch_occluder(const std::string& name, bool on) {
    const std::string what = "switching " + name + (on ? " on" : " off");
    ask(what, [this, name, on, what](Progress& progress) {
        std::set<std::string> off = bench_->shown()->document.off;
        if (on) {
            off.erase(name);
        } else {
            off.insert(name);
        }
        bench_->switch_off(off, what, progress);
    });
}

/// All occluders that are on, each where it is now; nothing where that is what the recipe says anyway.
std::optional<std::vector<OccluderUse>> Session::uses_now() const {
    const std::map<std::string, std::vector<MotionPose>> motions = occluders.motions();
    const std::set<std::string>& off = shown_->document.off;
    if (off.empty() && motions.empty() && !occluders.dragging()) {
        return std::nullopt;
    }
    std::vector<OccluderUse> uses;
    for (const OccluderView& occluder : shown_->occluders) {
        if (off.contains(occluder.name)) {
            continue;
        }
        OccluderUse& use = uses.emplace_back();
        use.name = occluder.name;
        if (const auto motion = motions.find(occluder.name); motion != motions.end()) {
            use.motion = motion->second;
        } else if (occluders.dragging() && occluder.name == occluders.selected()) {
            use.transform = occluders.shown(occluder);
        }
    }
    return uses;
}

/// The surface point nearest to where the first hammer ends is what its reach is measured from.
Anchors Session::strike_anchor() const {
    for (const OccluderView& occluder : shown_->occluders) {
        if (occluders.motions().contains(occluder.name)) {
            const Vec3 end = placed_point(occluders.shown(occluder), occluder.pivot);
            return {0, {SurfaceAddress(NearestAddress{end})}, {}};
        }
    }
    return {};
}

Edit Session::pending() const {
    Edit edit;
    if (editor.has_handles()) {
        edit = editor.edit();
    } else {
        edit.refine = editor.refine;
        if (options.near_strike) {
            edit.radius = editor.radius;
            edit.metric = editor.metric;
            edit.anchors.push_back(strike_anchor());
        }
    }
    edit.occluders = uses_now();
    edit.dilation = options.dilation;
    return edit;
}

void Session::leave_pending() {
    editor.clear();
    occluders.clear_motions();
    looked_ahead_ = true;
    refused_ = false;
}

void Session::options_changed() {
    if (has_pending()) {
        follow();
    }
}

/// What is under way is shown: the edit, or what an occluder that is dragged touches.
void Session::follow() {
    worker_->cancel(ahead);
    if (has_pending()) {
        followed_at_ = std::chrono::steady_clock::now();
        looked_ahead_ = false;
        const auto job = [this, edit = pending(), opening = shown_->opening](Progress& progress) {
            if (bench_->shown()->opening != opening) {
                return; // another file was opened meanwhile
            }
            refused_ = true;
            bench_->preview(edit, progress);
            refused_ = false;
        };
        ask("following", job, "preview");
    } else if (occluders.dragging()) {
        Edit uses;
        uses.occluders = uses_now();
        ask(
            "measuring contact", [this, uses](Progress&) { bench_->touch(uses); }, "touch");
    } else if (shown_->drag || shown_->standing) {
        ask("dropping the edit", [this](Progress&) { bench_->drop_preview(); });
    }
}

void Session::follow_occluders() {
    switch (occluders.take_wish()) {
    case OccluderWish::preview:
        follow();
        break;
    case OccluderWish::moved:
        move_occluder(occluders.selected());
        break;
    case OccluderWish::nothing:
        break;
    }
    const bool idle = worker_->idle();
    if (idle && shown_ == bench_->shown()) {
        occluders.settle();
    }
    if (idle && shown_->drag && !shown_->drag->contact && has_pending()) {
        ask(
            "measuring contact", [this](Progress&) { bench_->measure_contact(); }, "contact");
    }
    if (idle && outcome_due() && std::chrono::steady_clock::now() - followed_at_ > rest_before_outcome) {
        look_ahead();
    }
}

/// What of the edit under way a drag does not show, and has not been asked for yet.
bool Session::outcome_due() const {
    return !looked_ahead_ && has_pending() && !refused_ && (editor.refine || options.dilation);
}

void Session::look_ahead() {
    looked_ahead_ = true;
    ask(ahead, [this, edit = pending()](Progress& progress) {
        try {
            bench_->look_ahead(edit, progress);
        } catch (const Cancelled&) {
            return; // the edit has changed meanwhile, or the person does not want to wait
        }
    });
}

void Session::move_occluder(const std::string& name) {
    Recipe next = *shown_->document.recipe;
    for (size_t i = 0; i < next.occluders.size() && i < shown_->occluders.size(); ++i) {
        if (next.occluders[i].name == name) {
            next.occluders[i].transform = occluders.shown(shown_->occluders[i]);
        }
    }
    change(next, "occluder's place");
}

bool Session::occluder_key(const InputEvent& event) {
    const bool escape = event.key == key_of("escape");
    if (event.modifiers.control || event.modifiers.alt) {
        return false;
    }
    if (event.key == key_of("enter") && occluders.has_motion()) {
        commit();
    } else if (escape && occluders.has_motion()) {
        drop();
    } else if (escape) {
        occluders.select("");
    } else {
        return false;
    }
    return true;
}

std::string Session::hint() const {
    if (occluders.dragging()) {
        return occluders.hint();
    }
    if (occluders.has_motion() && !editor.has_handles()) {
        return "A hammer's motion is recorded   drag on: more of it   Enter: take   Esc: drop";
    }
    if (occluders.picks) {
        return "Click an occluder, then drag its arrows (move), squares (in a plane), rings (turn) or corner "
               "(scale)   O: back to the surface";
    }
    return editor.hint();
}

} // namespace anvil
