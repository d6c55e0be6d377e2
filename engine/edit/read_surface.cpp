#include "engine/edit/recipe_parts.h"

#include "engine/core/error.h"

namespace anvil {

namespace {

std::optional<double> read_number(const JsonReader& owner, const std::string& key) {
    const auto value = owner.find(key);
    return value ? std::optional<double>(value->number()) : std::nullopt;
}

Knot read_knot(const JsonReader& knot) {
    knot.check_keys({"t", "value", "tangent", "left", "right"});
    Knot result;
    result.t = knot.required("t").number();
    result.value = knot.required("value").number();
    result.left = read_number(knot, "left");
    result.right = read_number(knot, "right");
    if (const auto tangent = read_number(knot, "tangent")) {
        if (result.left || result.right) {
            knot.fail("\"tangent\" stands for both sides; give it alone, or \"left\" and \"right\"");
        }
        result.left = result.right = tangent;
    }
    return result;
}

SurfaceAddress read_face(const JsonReader& point) {
    FaceAddress address;
    address.face = point.required("face").index();
    if (const auto triangle = point.find("triangle")) {
        address.triangle = triangle->index();
    }
    const auto weights = point.find("barycentric");
    if (!weights) {
        point.fail("a whole face is an anchor, not a point; add \"barycentric\": [b0, b1, b2] for a point "
                   "inside it");
    }
    const Vec3 b = weights->vector();
    try {
        address.barycentric = checked_barycentric({b.x, b.y, b.z});
    } catch (const InputError& error) {
        weights->fail(error.what());
    }
    return address;
}

} // namespace

std::vector<Knot> read_knots(const JsonReader& list) {
    std::vector<Knot> knots;
    for (const JsonReader& item : list.items()) {
        knots.push_back(read_knot(item));
    }
    return knots;
}

ShapeChoice read_shape(const JsonReader& shape) {
    ShapeChoice choice;
    if (shape.is_string()) {
        choice.preset = shape.text();
        try {
            preset_knots(choice.preset);
        } catch (const InputError& error) {
            shape.fail(error.what());
        }
        return choice;
    }
    if (!shape.is_object()) {
        shape.fail_found("must be a preset (" + preset_list() + ") or {\"knots\": [...]}");
    }
    shape.check_keys({"knots"});
    choice.preset.clear();
    choice.knots = read_knots(shape.required("knots"));
    try {
        ShapeFunction check(choice.knots);
    } catch (const InputError& error) {
        shape.fail_inside(error.what());
    }
    return choice;
}

SurfaceAddress read_address(const JsonReader& point) {
    if (point.has("polyline")) {
        point.fail("a polyline is an anchor, not a point; give \"vertex\", \"face\" or \"nearest\"");
    }
    point.check_keys({"vertex", "face", "triangle", "barycentric", "nearest"});
    const int forms = int(point.has("vertex")) + int(point.has("face")) + int(point.has("nearest"));
    if (forms != 1) {
        point.fail("a point is given by exactly one of \"vertex\", \"face\" (with \"barycentric\") and "
                   "\"nearest\"");
    }
    if (point.has("face")) {
        return read_face(point);
    }
    point.check_keys({"vertex", "nearest"});
    if (const auto vertex = point.find("vertex")) {
        return VertexAddress{vertex->index()};
    }
    return NearestAddress{point.required("nearest").vector()};
}

std::vector<SurfaceAddress> read_addresses(const JsonReader& list) {
    std::vector<SurfaceAddress> addresses;
    for (const JsonReader& item : list.items()) {
        addresses.push_back(read_address(item));
    }
    return addresses;
}

AnchorAddress read_anchor(const JsonReader& anchor) {
    anchor.check_keys({"vertex", "face", "triangle", "barycentric", "nearest", "polyline"});
    if (anchor.has("polyline")) {
        anchor.check_keys({"polyline"});
        const JsonReader line = anchor.required("polyline");
        PolylineAddress address{read_addresses(line)};
        if (address.points.size() < 2) {
            line.fail_found("a line takes two points or more");
        }
        return address;
    }
    if (anchor.has("face") && !anchor.has("barycentric") && !anchor.has("triangle")) {
        anchor.check_keys({"face"});
        return WholeFaceAddress{anchor.required("face").index()};
    }
    return read_address(anchor);
}

} // namespace anvil
