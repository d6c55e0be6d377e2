#include "engine/edit/recipe_parts.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

// The lengths that a shape consists of, all greater than 0.
struct Lengths {
    JsonReader shape;

    Lengths(const JsonReader& reader, const std::vector<std::string>& keys) : shape(reader) {
        shape.check_keys(keys);
    }
    double operator()(const char* key) const { return shape.required(key).positive(); }
};

BoxShape read_box(const JsonReader& shape) {
    shape.check_keys({"half", "rounding"});
    const JsonReader half = shape.required("half");
    BoxShape box{half.vector(), 0};
    const double shortest = std::min({box.half.x, box.half.y, box.half.z});
    if (!(shortest > 0)) {
        half.fail_found("the half extents must be greater than 0");
    }
    if (const auto rounding = shape.find("rounding")) {
        box.rounding = rounding->within(0, shortest);
    }
    return box;
}

TorusShape read_torus(const JsonReader& shape) {
    const Lengths length(shape, {"major", "minor"});
    const TorusShape torus{length("major"), length("minor")};
    if (torus.minor > torus.major) {
        shape.required("minor").fail_found("must not exceed \"major\"");
    }
    return torus;
}

PlaneShape read_plane(const JsonReader& shape) {
    shape.check_keys({"normal", "offset"});
    PlaneShape plane{shape.required("normal").direction(), 0};
    if (const auto offset = shape.find("offset")) {
        plane.offset = offset->number();
    }
    return plane;
}

std::string read_path(const JsonReader& file, const std::string& what) {
    if (file.text().empty()) {
        file.fail_found("must be the path of " + what + " file, relative to the recipe");
    }
    return file.text();
}

void refuse_motion(const JsonReader& occluder) {
    if (occluder.has("motion")) {
        occluder.required("motion").fail("an occluder moves during an edit: move this into the edit's own "
                                         "\"occluders\": [{\"name\": ..., \"motion\": [...]}]");
    }
}

CsgPart read_part(const JsonReader& part) {
    part.check_keys({"name", "shape", "transform", "influence", "field", "motion"});
    refuse_motion(part);
    for (const char* key : {"influence", "field"}) {
        if (part.has(key)) {
            part.fail(std::string("\"") + key + "\" belongs to the whole occluder; remove it from this part");
        }
    }
    CsgPart result;
    if (const auto name = part.find("name")) {
        result.name = name->text();
    }
    result.shape = read_occluder_shape(part.required("shape"));
    if (const auto transform = part.find("transform")) {
        result.transform = read_transform(*transform);
    }
    return result;
}

CsgShape read_csg(const JsonReader& list, CsgOperation operation) {
    CsgShape csg{operation, {}};
    for (const JsonReader& part : list.items()) {
        csg.parts.push_back(read_part(part));
    }
    if (csg.parts.empty()) {
        list.fail_found("must hold at least one occluder {\"shape\": ..., \"transform\": ...}");
    }
    return csg;
}

OccluderShape::Solid read_solid(const std::string& kind, const JsonReader& shape) {
    if (kind == "sphere") {
        return SphereShape{Lengths(shape, {"radius"})("radius")};
    }
    if (kind == "box") {
        return read_box(shape);
    }
    if (kind == "torus") {
        return read_torus(shape);
    }
    if (kind == "plane") {
        return read_plane(shape);
    }
    if (kind == "mesh") {
        return MeshShape{read_path(shape, "a mesh")};
    }
    if (kind == "vdb") {
        return VdbShape{read_path(shape, "a .vdb"), ""};
    }
    if (kind == "union" || kind == "intersection" || kind == "subtract") {
        return read_csg(shape, kind == "union"      ? CsgOperation::unite
                               : kind == "subtract" ? CsgOperation::subtract
                                                    : CsgOperation::intersect);
    }
    const Lengths length(shape, {"radius", "height"});
    if (kind == "cylinder") {
        return CylinderShape{length("radius"), length("height")};
    }
    if (kind == "capsule") {
        return CapsuleShape{length("radius"), length("height")};
    }
    return ConeShape{length("radius"), length("height")};
}

double read_scale(const JsonReader& scale) {
    if (scale.is_list()) {
        scale.fail_found("scale is one number for all axes: a non-uniform scale would falsify distances");
    }
    return scale.positive();
}

void read_rotation(const JsonReader& rotate, Transform& transform) {
    rotate.check_keys({"axis", "degrees"});
    if (!rotate.has("axis")) {
        rotate.fail("a rotation needs an \"axis\": [x, y, z]");
    }
    transform.axis = rotate.required("axis").direction();
    transform.degrees = rotate.required("degrees").number();
}

Influence read_curve(const JsonReader& influence) {
    if (influence.has("kind")) {
        influence.fail("an influence has either a \"kind\" or \"knots\" and \"width\"");
    }
    influence.check_keys({"knots", "width"});
    Influence result;
    result.kind = InfluenceKind::curve;
    result.knots = read_knots(influence.required("knots"));
    result.width = influence.required("width").positive();
    try {
        // The factor allows for rounding of a maximum of exactly 1.
        if (ShapeFunction(result.knots).max_magnitude() > 1 + 1e-12) {
            influence.required("knots").fail(
                "an influence curve must stay within [-1, 1], between its knots too");
        }
    } catch (const InputError& error) {
        const std::string message = error.what();
        if (message.rfind("knots", 0) == 0) {
            influence.fail_inside(message);
        }
        throw;
    }
    return result;
}

std::optional<Field> read_field(const JsonReader& occluder, const OccluderShape& shape) {
    const auto field = occluder.find("field");
    if (!field) {
        return std::nullopt;
    }
    field->check_keys({"kind", "resolution"});
    Field result;
    result.kind = field->required("kind").word<FieldKind>(
        {{"exact", FieldKind::exact}, {"dense", FieldKind::dense}, {"adaptive", FieldKind::adaptive}});
    if (const auto resolution = field->find("resolution")) {
        result.resolution = resolution->whole(8, 1024);
    }
    if (result.kind == FieldKind::exact && !has_formula(shape)) {
        field->fail("a mesh or level set has no formula: use \"kind\": \"adaptive\", or leave \"field\" out");
    }
    if (result.kind != FieldKind::exact && !is_bounded(shape)) {
        field->fail(
            "a plane cannot be baked, since no box holds it; use \"kind\": \"exact\", or cut it off by an "
            "\"intersection\" with a bounded shape");
    }
    return result;
}

std::string read_name(const JsonReader& owner) {
    const JsonReader name = owner.required("name");
    if (name.text().empty()) {
        name.fail_found("must not be empty");
    }
    return name.text();
}

} // namespace

Transform read_transform(const JsonReader& transform) {
    transform.check_keys({"translate", "rotate", "scale"});
    return read_pose_keys(transform);
}

Transform read_pose_keys(const JsonReader& transform) {
    Transform result;
    if (const auto translate = transform.find("translate")) {
        result.translate = translate->vector();
    }
    if (const auto rotate = transform.find("rotate")) {
        read_rotation(*rotate, result);
    }
    if (const auto scale = transform.find("scale")) {
        result.scale = read_scale(*scale);
    }
    return result;
}

Influence read_influence(const JsonReader& influence) {
    influence.check_keys({"kind", "strength", "sigma", "knots", "width"});
    if (influence.has("knots") || influence.has("width")) {
        return read_curve(influence);
    }
    Influence result;
    if (const auto kind = influence.find("kind")) {
        result.kind = kind->word<InfluenceKind>(
            {{"paper", InfluenceKind::paper}, {"hard", InfluenceKind::hard}, {"soft", InfluenceKind::soft}});
    }
    for (const char* key : {"strength", "sigma"}) {
        if (result.kind != InfluenceKind::soft && influence.has(key)) {
            influence.required(key).fail_found("only \"soft\" has it; remove it or use \"kind\": \"soft\"");
        }
    }
    if (const auto strength = influence.find("strength")) {
        result.strength = strength->within(0, 1);
    }
    if (const auto sigma = influence.find("sigma")) {
        result.sigma = sigma->positive();
    }
    return result;
}

OccluderShape read_occluder_shape(const JsonReader& shape) {
    const std::vector<std::string> kinds{"sphere", "box",  "cylinder", "capsule", "cone",         "torus",
                                         "plane",  "mesh", "vdb",      "union",   "intersection", "subtract"};
    std::vector<std::string> keys = kinds;
    keys.emplace_back("grid");
    shape.check_keys(keys);
    std::optional<OccluderShape::Solid> solid;
    for (const std::string& kind : kinds) {
        if (!shape.has(kind)) {
            continue;
        }
        if (solid) {
            shape.fail("found several shapes; an occluder has one, join several by \"union\": [...]");
        }
        solid = read_solid(kind, shape.required(kind));
    }
    if (!solid) {
        shape.fail_found("must name a shape, e.g. {\"sphere\": {\"radius\": 1}}");
    }
    if (const auto grid = shape.find("grid")) {
        auto* vdb = std::get_if<VdbShape>(&*solid);
        if (vdb == nullptr) {
            grid->fail_found("names a grid of a \"vdb\" shape; remove it");
        }
        vdb->grid = grid->text();
    }
    return {*solid};
}

Occluder read_occluder(const JsonReader& occluder) {
    occluder.check_keys({"name", "shape", "field", "transform", "influence", "motion"});
    refuse_motion(occluder);
    Occluder result;
    result.name = read_name(occluder);
    result.shape = read_occluder_shape(occluder.required("shape"));
    result.field = read_field(occluder, result.shape);
    if (const auto transform = occluder.find("transform")) {
        result.transform = read_transform(*transform);
    }
    if (const auto influence = occluder.find("influence")) {
        result.influence = read_influence(*influence);
    }
    return result;
}

OccluderUse read_occluder_use(const JsonReader& use) {
    OccluderUse result;
    if (use.is_string()) {
        result.name = use.text();
        return result;
    }
    use.check_keys({"name", "transform", "influence", "motion"});
    result.name = read_name(use);
    if (const auto transform = use.find("transform")) {
        result.transform = read_transform(*transform);
    }
    if (const auto influence = use.find("influence")) {
        result.influence = read_influence(*influence);
    }
    if (const auto motion = use.find("motion")) {
        result.motion = read_motion(*motion);
    }
    return result;
}

} // namespace anvil
