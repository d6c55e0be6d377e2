#include "engine/edit/handle_path.h"
#include "engine/edit/recipe_parts.h"

#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

namespace {

DistanceMethod read_method(const JsonReader& method) {
    return method.word<DistanceMethod>({{"auto", DistanceMethod::automatic},
                                        {"approximate", DistanceMethod::approximate},
                                        {"exact", DistanceMethod::exact}});
}

Metric read_metric(const JsonReader& metric) {
    return metric.word<Metric>({{"geodesic", Metric::geodesic}, {"euclidean", Metric::euclidean}});
}

void check_target_keys(const JsonReader& handle, EditKind kind) {
    const bool moves = kind == EditKind::translate;
    const std::string choice = moves ? R"("by" or "to" (or a "path"))" : R"("degrees" or "to")";
    const auto given = [&](const std::vector<std::string>& keys) {
        std::vector<std::string> found;
        std::copy_if(keys.begin(), keys.end(), std::back_inserter(found),
                     [&](const std::string& key) { return handle.has(key); });
        return found;
    };
    using Words = std::vector<std::string>;
    if (const Words foreign = given(moves ? Words{"degrees"} : Words{"by", "path"}); !foreign.empty()) {
        handle.fail("\"" + foreign[0] + "\" does not fit " + (moves ? "a translation" : "a rotation") +
                    "; give " + choice);
    }
    const Words own = given(moves ? Words{"by", "to", "path"} : Words{"degrees", "to"});
    if (own.size() > 1) {
        handle.fail("found both \"" + own[0] + "\" and \"" + own[1] + "\"; give one of them");
    }
    if (own.empty()) {
        handle.fail("the handle has no target; give " + choice);
    }
}

std::vector<Vec3> read_path(const JsonReader& path) {
    std::vector<Vec3> offsets;
    for (const JsonReader& item : path.items()) {
        offsets.push_back(item.vector());
    }
    if (offsets.size() < 2) {
        path.fail_found("a path has at least two offsets from the handle's start, e.g. [[0,0,0], [0,1,0], "
                        "[1,1,0]]; for one straight move give \"by\"");
    }
    try {
        HandlePath{offsets};
    } catch (const InputError& error) {
        path.fail(error.what());
    }
    return offsets;
}

Handle read_handle(const JsonReader& handle, EditKind kind) {
    handle.check_keys({"at", "by", "to", "path", "degrees", "radius", "shape", "metric"});
    check_target_keys(handle, kind);
    Handle result;
    result.at = read_address(handle.required("at"));
    if (const auto by = handle.find("by")) {
        result.by = by->vector();
    }
    if (const auto to = handle.find("to")) {
        result.to = to->vector();
    }
    if (const auto path = handle.find("path")) {
        result.path = read_path(*path);
    }
    if (const auto degrees = handle.find("degrees")) {
        result.degrees = degrees->number();
    }
    if (const auto radius = handle.find("radius")) {
        result.radius = radius->positive();
    }
    if (const auto shape = handle.find("shape")) {
        result.shape = read_shape(*shape);
    }
    if (const auto metric = handle.find("metric")) {
        result.metric = read_metric(*metric);
    }
    return result;
}

/// The width of a smooth blend.
std::optional<double> read_blend(const JsonReader& blend) {
    if (blend.is_string() && blend.text() == "min") {
        return std::nullopt;
    }
    if (!blend.is_object()) {
        blend.fail_found("must be \"min\" (the nearest anchor counts) or {\"smooth\": width}");
    }
    blend.check_keys({"smooth"});
    return blend.required("smooth").positive();
}

Anchors read_anchors(const JsonReader& anchors, size_t handle_count) {
    anchors.check_keys({"handle", "at", "blend"});
    Anchors result;
    if (handle_count == 0 && anchors.has("handle")) {
        anchors.required("handle").fail(
            "the edit has no handles: its anchors say where the hammer may act; remove this");
    }
    if (handle_count > 1 || anchors.has("handle")) {
        result.handle = anchors.required("handle").whole(0, static_cast<uint32_t>(handle_count - 1));
    }
    const JsonReader at = anchors.required("at");
    for (const JsonReader& item : at.items()) {
        result.at.push_back(read_anchor(item));
    }
    if (result.at.empty()) {
        at.fail_found("must hold at least one point, polyline or face");
    }
    if (const auto blend = anchors.find("blend")) {
        result.smooth_width = read_blend(*blend);
    }
    return result;
}

void read_all_anchors(const JsonReader& list, Edit& edit) {
    std::vector<bool> seen(std::max<size_t>(edit.handles.size(), 1), false);
    for (const JsonReader& item : list.items()) {
        edit.anchors.push_back(read_anchors(item, edit.handles.size()));
        const uint32_t handle = edit.anchors.back().handle;
        if (seen[handle]) {
            item.fail((edit.handles.empty() ? "the edit" : "handle " + std::to_string(handle)) +
                      " has anchors already; list all points in one \"at\"");
        }
        seen[handle] = true;
    }
}

Steps read_steps(const JsonReader& steps) {
    steps.check_keys({"count", "max"});
    if (steps.has("count") == steps.has("max")) {
        steps.fail("give either \"count\" (equal steps) or \"max\" (adaptive steps)");
    }
    constexpr uint32_t most = 1000000;
    if (const auto count = steps.find("count")) {
        return {false, count->whole(1, most)};
    }
    return {true, steps.required("max").whole(1, most)};
}

void read_rotation(const JsonReader& edit, Edit& result) {
    if (!edit.has("axis")) {
        edit.fail("a rotation needs an \"axis\": {\"origin\": [x, y, z], \"direction\": [x, y, z]}");
    }
    const JsonReader axis = edit.required("axis");
    axis.check_keys({"origin", "direction"});
    result.axis = {axis.required("origin").vector(), axis.required("direction").direction()};
    if (const auto sweep = edit.find("sweep")) {
        result.sweep = sweep->word<Sweep>({{"arc", Sweep::arc}, {"chord", Sweep::chord}});
    }
}

void refuse_rotation_keys(const JsonReader& edit) {
    for (const char* key : {"axis", "sweep"}) {
        if (edit.has(key)) {
            edit.required(key).fail("belongs to a rotation; remove it or use \"kind\": \"rotate\"");
        }
    }
}

void read_handles(const JsonReader& list, Edit& edit) {
    for (const JsonReader& item : list.items()) {
        edit.handles.push_back(read_handle(item, edit.kind));
    }
}

/// Of smooth_surface; handles and metric are read already.
uint32_t read_rounds(const JsonReader& rounds, const Edit& edit) {
    constexpr uint32_t most = 1000;
    const uint32_t count = rounds.whole(0, most);
    const bool hammered = edit.handles.empty() && edit.metric == Metric::geodesic;
    const bool geodesic =
        hammered || std::any_of(edit.handles.begin(), edit.handles.end(), [&](const Handle& handle) {
            return handle.metric.value_or(edit.metric) == Metric::geodesic;
        });
    if (count > 0 && !geodesic) {
        rounds.fail("Euclidean distances do not run over the surface; remove the key, or use "
                    "\"metric\": \"geodesic\"");
    }
    return count;
}

void read_distances(const JsonReader& edit, Edit& result) {
    if (const auto anchors = edit.find("anchors")) {
        read_all_anchors(*anchors, result);
    }
    if (const auto metric = edit.find("metric")) {
        result.metric = read_metric(*metric);
    }
    if (const auto method = edit.find("method")) {
        result.method = read_method(*method);
    }
    if (const auto rounds = edit.find("smooth_surface")) {
        result.smooth_surface = read_rounds(*rounds, result);
    }
    if (const auto radius = edit.find("radius")) {
        result.radius = radius->positive();
    }
    if (const auto shape = edit.find("shape")) {
        result.shape = read_shape(*shape);
    }
}

void read_options(const JsonReader& edit, Edit& result) {
    if (const auto uses = edit.find("occluders")) {
        result.occluders.emplace();
        for (const JsonReader& use : uses->items()) {
            result.occluders->push_back(read_occluder_use(use));
        }
    }
    if (const auto steps = edit.find("steps")) {
        result.steps = read_steps(*steps);
    }
    if (const auto least_squares = edit.find("least_squares")) {
        result.least_squares = least_squares->boolean();
    }
    if (const auto refine = edit.find("refine")) {
        result.refine = read_refine(*refine);
    }
    if (const auto amount = edit.find("amount")) {
        result.amount = amount->within(0, 1);
    }
    if (const auto dilation = edit.find("dilation")) {
        result.dilation = read_dilation(*dilation);
    }
    if (const auto pinned = edit.find("pinned")) {
        result.pinned = read_addresses(*pinned);
    }
    if (const auto mirror = edit.find("mirror")) {
        result.mirror = read_mirror(*mirror);
    }
}

bool has_hammer(const Edit& edit) {
    return edit.occluders && std::any_of(edit.occluders->begin(), edit.occluders->end(),
                                         [](const OccluderUse& use) { return !use.motion.empty(); });
}

/// Without handles it is the occluders that move, and nothing has a shape function.
void check_handleless(const JsonReader& edit, const Edit& parsed) {
    if (!has_hammer(parsed)) {
        edit.fail(
            R"(an edit needs at least one handle, or an occluder that moves: "occluders": [{"name": ..., )"
            R"("motion": [{"at": 0, ...}, {"at": 1, ...}]}])");
    }
    if (parsed.kind == EditKind::rotate) {
        edit.required("kind").fail_found("without handles nothing turns; use \"translate\"");
    }
    if (parsed.mirror && parsed.anchors.empty()) {
        edit.required("mirror").fail("it repeats handles and anchors, and the edit has none; remove it");
    }
    for (const char* key : {"shape", "least_squares"}) {
        if (edit.has(key)) {
            edit.required(key).fail("belongs to handles, and the edit has none; remove it");
        }
    }
    if (parsed.refine && parsed.refine->criterion != RefineCriterion::space) {
        edit.required("refine").fail("without handles there is no shape to refine by; use {\"criterion\": "
                                     "\"space\", \"tolerance\": ...}");
    }
    if (parsed.radius && parsed.anchors.empty()) {
        edit.required("radius").fail("without handles the radius is that of \"anchors\", and the edit has "
                                     "none; give them, or leave the "
                                     "radius out so that the whole mesh takes part");
    }
}

} // namespace

Edit read_edit(const JsonReader& edit) {
    edit.check_keys({"kind", "handles", "anchors", "axis", "sweep", "metric", "method", "radius", "shape",
                     "occluders", "steps", "least_squares", "amount", "pinned", "refine", "smooth_surface",
                     "dilation", "mirror"});
    Edit result;
    result.kind = edit.required("kind").word<EditKind>(
        {{"translate", EditKind::translate}, {"rotate", EditKind::rotate}});
    if (result.kind == EditKind::rotate) {
        read_rotation(edit, result);
    } else {
        refuse_rotation_keys(edit);
    }
    if (const auto handles = edit.find("handles")) {
        read_handles(*handles, result);
    }
    read_distances(edit, result);
    read_options(edit, result);
    if (result.handles.empty()) {
        check_handleless(edit, result);
    }
    if (result.dilation && result.refine && result.refine->criterion != RefineCriterion::shape) {
        edit.required("refine").fail(
            "what dilation raises depends on the whole contact and is not seen between "
            "vertices; use the criterion \"shape\"");
    }
    return result;
}

} // namespace anvil
