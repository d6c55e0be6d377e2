#include "engine/edit/recipe_parts.h"

#include <nlohmann/json.hpp>

namespace anvil {

namespace {

const char* name_of(FieldKind kind) {
    return kind == FieldKind::exact ? "exact" : kind == FieldKind::dense ? "dense" : "adaptive";
}

using Json = nlohmann::ordered_json;

struct SolidWriter {
    Json operator()(const SphereShape& s) const { return {{"sphere", {{"radius", s.radius}}}}; }
    Json operator()(const BoxShape& s) const {
        return {{"box", {{"half", written(s.half)}, {"rounding", s.rounding}}}};
    }
    Json operator()(const CylinderShape& s) const { return round("cylinder", s.radius, s.height); }
    Json operator()(const CapsuleShape& s) const { return round("capsule", s.radius, s.height); }
    Json operator()(const ConeShape& s) const { return round("cone", s.radius, s.height); }
    Json operator()(const TorusShape& s) const {
        return {{"torus", {{"major", s.major}, {"minor", s.minor}}}};
    }
    Json operator()(const PlaneShape& s) const {
        return {{"plane", {{"normal", written(s.normal)}, {"offset", s.offset}}}};
    }
    Json operator()(const MeshShape& s) const { return {{"mesh", s.file}}; }
    Json operator()(const VdbShape& s) const {
        Json result{{"vdb", s.file}};
        if (!s.grid.empty()) {
            result["grid"] = s.grid;
        }
        return result;
    }
    Json operator()(const CsgShape& s) const {
        Json parts = Json::array();
        for (const CsgPart& part : s.parts) {
            Json entry = Json::object();
            if (!part.name.empty()) {
                entry["name"] = part.name;
            }
            entry["shape"] = written(part.shape);
            entry["transform"] = written(part.transform);
            parts.push_back(std::move(entry));
        }
        const char* key = s.operation == CsgOperation::unite       ? "union"
                          : s.operation == CsgOperation::intersect ? "intersection"
                                                                   : "subtract";
        return {{key, std::move(parts)}};
    }

    static Json round(const char* kind, double radius, double height) {
        return {{kind, {{"radius", radius}, {"height", height}}}};
    }
};

} // namespace

Json written(const Transform& transform) {
    return {{"translate", written(transform.translate)},
            {"rotate", {{"axis", written(transform.axis)}, {"degrees", transform.degrees}}},
            {"scale", transform.scale}};
}

Json written(const Influence& influence) {
    switch (influence.kind) {
    case InfluenceKind::paper:
        return {{"kind", "paper"}};
    case InfluenceKind::hard:
        return {{"kind", "hard"}};
    case InfluenceKind::curve:
        return {{"knots", written(influence.knots)}, {"width", influence.width}};
    case InfluenceKind::soft:
        break;
    }
    Json result{{"kind", "soft"}, {"strength", influence.strength}};
    if (influence.sigma) {
        result["sigma"] = *influence.sigma;
    }
    return result;
}

Json written(const OccluderShape& shape) {
    return std::visit(SolidWriter(), shape.solid);
}

Json written(const Occluder& occluder) {
    Json result{{"name", occluder.name}, {"shape", written(occluder.shape)}};
    if (occluder.field) {
        result["field"] = {{"kind", name_of(occluder.field->kind)},
                           {"resolution", occluder.field->resolution}};
    }
    result["transform"] = written(occluder.transform);
    result["influence"] = written(occluder.influence);
    return result;
}

Json written(const MotionPose& pose) {
    Json result{{"at", pose.at}};
    if (pose.translate) {
        result["translate"] = written(*pose.translate);
    }
    if (pose.rotate) {
        result["rotate"] = {{"axis", written(pose.rotate->axis)}, {"degrees", pose.rotate->degrees}};
    }
    if (pose.scale) {
        result["scale"] = *pose.scale;
    }
    return result;
}

Json written(const OccluderUse& use) {
    if (!use.transform && !use.influence && use.motion.empty()) {
        return use.name;
    }
    Json result{{"name", use.name}};
    if (use.transform) {
        result["transform"] = written(*use.transform);
    }
    if (use.influence) {
        result["influence"] = written(*use.influence);
    }
    for (const MotionPose& pose : use.motion) {
        result["motion"].push_back(written(pose));
    }
    return result;
}

} // namespace anvil
