#include "engine/forge/report.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace anvil {

namespace {

using Json = nlohmann::ordered_json;

Json number(double x) {
    return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json contact_json(const ContactReport& c) {
    return {
        {"started_inside", c.started_inside},           {"penetrating_vertices", c.penetrating_vertices},
        {"max_penetration", number(c.max_penetration)}, {"penetrating_triangles", c.penetrating_triangles},
        {"deepest_dip", number(c.deepest_dip)},         {"finished_on_cpu", c.finished_on_cpu},
        {"contact_vertices", c.contact_vertices}};
}

Json refine_json(const std::optional<RefineSummary>& r) {
    if (!r) {
        return {{"added", 0},
                {"max_error", nullptr},
                {"stopped_by", nullptr},
                {"parted_edges", 0},
                {"parted_error", 0},
                {"min_angle_before", nullptr},
                {"min_angle_after", nullptr}};
    }
    return {{"added", r->added},
            {"max_error", number(r->max_error)},
            {"stopped_by", r->stopped_by},
            {"parted_edges", r->parted_edges},
            {"parted_error", number(r->parted_error)},
            {"min_angle_before", number(r->min_angle_before)},
            {"min_angle_after", number(r->min_angle_after)}};
}

Json handles_json(const EditReport& edit) {
    Json handles = Json::array();
    for (size_t j = 0; j < edit.target_errors.size(); ++j) {
        handles.push_back({{"target_error", number(edit.target_errors[j])},
                           {"radius", number(edit.radii[j])},
                           {"method", edit.distance_methods[j]}});
    }
    return handles;
}

/// The volume's error as a share of what it should be; null for open meshes.
Json dilation_json(const DilationReport& dilation, const std::optional<VolumeChange>& volume) {
    Json json = {{"width", number(dilation.width)},
                 {"height", number(dilation.height)},
                 {"volume_without_occluders", nullptr},
                 {"volume_error", nullptr}};
    if (volume && volume->without_occluders) {
        json["volume_without_occluders"] = number(*volume->without_occluders);
        json["volume_error"] = number(std::abs(volume->after / *volume->without_occluders - 1));
    }
    return json;
}

Json edit_json(const EditReport& e) {
    Json json = {{"kind", e.kind},
                 {"region", e.region},
                 {"moved", e.moved},
                 {"rank", e.rank},
                 {"condition", number(e.condition)},
                 {"amplification", number(e.amplification)},
                 {"handles", handles_json(e)},
                 {"steps",
                  {{"min", e.steps.min},
                   {"mean", number(e.steps.mean)},
                   {"max", e.steps.max},
                   {"limit_reached", e.steps.limit_reached}}},
                 {"samples", e.samples}};
    json["refine"] = refine_json(e.refine);
    json["occluder"] = contact_json(e.contact.value_or(ContactReport{}));
    json["occluder"]["contacts"] = Json::array();
    for (const ContactList& list : e.contacts) {
        json["occluder"]["contacts"].push_back(
            {{"name", list.name}, {"vertices", list.vertices}, {"triangles", list.triangles}});
    }
    json["volume"] = e.volume ? Json{{"before", number(e.volume->before)}, {"after", number(e.volume->after)}}
                              : Json(nullptr);
    json["dilation"] = nullptr;
    if (e.dilation) {
        json["dilation"] = dilation_json(*e.dilation, e.volume);
    }
    return json;
}

} // namespace

StageSeconds& StageSeconds::operator+=(const StageSeconds& more) {
    load += more.load;
    distance += more.distance;
    solve += more.solve;
    refine += more.refine;
    bake += more.bake;
    upload += more.upload;
    deform += more.deform;
    download += more.download;
    write += more.write;
    return *this;
}

std::string report_json(const ForgeReport& report) {
    const StageSeconds& s = report.seconds;
    Json json = {{"device", report.device},
                 {"driver", report.driver},
                 {"vertices", report.vertices},
                 {"faces", report.faces},
                 {"seconds",
                  {{"load", s.load},
                   {"distance", s.distance},
                   {"solve", s.solve},
                   {"refine", s.refine},
                   {"bake", s.bake},
                   {"upload", s.upload},
                   {"deform", s.deform},
                   {"download", s.download},
                   {"write", s.write}}}};
    json["edits"] = Json::array();
    for (const EditReport& edit : report.edits) {
        json["edits"].push_back(edit_json(edit));
    }
    json["warnings"] = report.warnings;
    // A warning may name a file whose name is not UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace anvil
