#include "engine/edit/recipe_json.h"

#include "engine/core/error.h"
#include "engine/edit/recipe_parts.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace anvil {

namespace {

using Json = nlohmann::ordered_json;

template <class Items>
Json list_of(const Items& items) {
    Json list = Json::array();
    for (const auto& item : items) {
        list.push_back(written(item));
    }
    return list;
}

const char* name_of(Metric metric) {
    return metric == Metric::geodesic ? "geodesic" : "euclidean";
}

const char* name_of(DistanceMethod method) {
    return method == DistanceMethod::automatic ? "auto"
           : method == DistanceMethod::exact   ? "exact"
                                               : "approximate";
}

void write_distances(const Edit& edit, Json& result) {
    if (!edit.anchors.empty()) {
        result["anchors"] = list_of(edit.anchors);
        if (edit.handles.empty()) {
            result["anchors"][0].erase("handle");
        }
    }
    result["metric"] = name_of(edit.metric);
    result["method"] = name_of(edit.method);
    if (edit.smooth_surface > 0) {
        result["smooth_surface"] = edit.smooth_surface;
    }
    if (edit.radius) {
        result["radius"] = *edit.radius;
    }
    if (!edit.handles.empty()) {
        result["shape"] = written(edit.shape);
    }
}

void write_options(const Edit& edit, Json& result) {
    if (edit.occluders) {
        result["occluders"] = list_of(*edit.occluders);
    }
    if (edit.steps) {
        result["steps"] = {{edit.steps->adaptive ? "max" : "count", edit.steps->count}};
    }
    if (edit.least_squares) {
        result["least_squares"] = true;
    }
    if (edit.refine) {
        result["refine"] = written(*edit.refine);
    }
    if (edit.amount != 1) {
        result["amount"] = edit.amount;
    }
    if (edit.dilation) {
        result["dilation"] = written(*edit.dilation);
    }
    if (edit.mirror) {
        result["mirror"] = written(*edit.mirror);
    }
    if (!edit.pinned.empty()) {
        result["pinned"] = list_of(edit.pinned);
    }
}

// JSON has no word for them: the library would write null, which no reader takes for a number.
void check_finite(const Json& value) {
    if (value.is_structured()) {
        for (const Json& item : value) {
            check_finite(item);
        }
    } else if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        throw InternalError("a number of the recipe is not finite");
    }
}

} // namespace

Json written(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json written(const std::vector<Knot>& knots) {
    Json list = Json::array();
    for (const Knot& knot : knots) {
        Json entry{{"t", knot.t}, {"value", knot.value}};
        if (knot.left && knot.left == knot.right) {
            entry["tangent"] = *knot.left;
        } else {
            if (knot.left) {
                entry["left"] = *knot.left;
            }
            if (knot.right) {
                entry["right"] = *knot.right;
            }
        }
        list.push_back(std::move(entry));
    }
    return list;
}

Json written(const ShapeChoice& shape) {
    return shape.preset.empty() ? Json{{"knots", written(shape.knots)}} : Json(shape.preset);
}

Json written(const SurfaceAddress& address) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        return {{"vertex", vertex->vertex}};
    }
    if (const auto* face = std::get_if<FaceAddress>(&address)) {
        const auto& b = face->barycentric;
        return {{"face", face->face},
                {"triangle", face->triangle},
                {"barycentric", Json::array({b[0], b[1], b[2]})}};
    }
    return {{"nearest", written(std::get<NearestAddress>(address).point)}};
}

Json written(const AnchorAddress& anchor) {
    if (const auto* line = std::get_if<PolylineAddress>(&anchor)) {
        return {{"polyline", list_of(line->points)}};
    }
    if (const auto* face = std::get_if<WholeFaceAddress>(&anchor)) {
        return {{"face", face->face}};
    }
    return written(std::get<SurfaceAddress>(anchor));
}

Json written(const Handle& handle) {
    Json result{{"at", written(handle.at)}};
    if (handle.by) {
        result["by"] = written(*handle.by);
    }
    if (handle.to) {
        result["to"] = written(*handle.to);
    }
    if (!handle.path.empty()) {
        result["path"] = list_of(handle.path);
    }
    if (handle.degrees) {
        result["degrees"] = *handle.degrees;
    }
    if (handle.radius) {
        result["radius"] = *handle.radius;
    }
    if (handle.shape) {
        result["shape"] = written(*handle.shape);
    }
    if (handle.metric) {
        result["metric"] = name_of(*handle.metric);
    }
    return result;
}

Json written(const Anchors& anchors) {
    return {{"handle", anchors.handle},
            {"at", list_of(anchors.at)},
            {"blend", anchors.smooth_width ? Json{{"smooth", *anchors.smooth_width}} : Json("min")}};
}

Json written(const Dilation& dilation) {
    Json result{{"form", dilation.form == DilationForm::depth ? "depth" : "volume"}};
    if (dilation.solve) {
        result["solve"] = true;
    } else {
        result["amount"] = dilation.amount;
    }
    if (dilation.width) {
        result["width"] = *dilation.width;
    }
    return result;
}

Json written(const Mirror& mirror) {
    Json result{{"axis", std::string(1, "xyz"[mirror.axis])}, {"origin", mirror.origin}};
    if (mirror.merge) {
        result["merge"] = *mirror.merge;
    }
    return result;
}

Json written(const Edit& edit) {
    Json result{{"kind", edit.kind == EditKind::translate ? "translate" : "rotate"}};
    if (edit.kind == EditKind::rotate) {
        result["axis"] = {{"origin", written(edit.axis.origin)}, {"direction", written(edit.axis.direction)}};
        result["sweep"] = edit.sweep == Sweep::arc ? "arc" : "chord";
    }
    result["handles"] = list_of(edit.handles);
    write_distances(edit, result);
    write_options(edit, result);
    return result;
}

std::string write_recipe(const Recipe& recipe) {
    Json document{{"anvil", 1}, {"mesh", recipe.mesh}};
    if (!recipe.occluders.empty()) {
        document["occluders"] = list_of(recipe.occluders);
    }
    document["edits"] = list_of(recipe.edits);
    check_finite(document);
    return document.dump(2) + "\n";
}

} // namespace anvil
