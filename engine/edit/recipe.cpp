#include "engine/edit/recipe.h"

#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

ShapeFunction make_shape_function(const ShapeChoice& choice) {
    return ShapeFunction(choice.preset.empty() ? choice.knots : preset_knots(choice.preset));
}

bool CsgShape::operator==(const CsgShape& other) const {
    return operation == other.operation && parts == other.parts;
}

bool is_bounded(const OccluderShape& shape) {
    const auto* csg = std::get_if<CsgShape>(&shape.solid);
    if (!csg) {
        return !std::holds_alternative<PlaneShape>(shape.solid);
    }
    const auto bounded = [](const CsgPart& part) { return is_bounded(part.shape); };
    switch (csg->operation) {
    case CsgOperation::unite:
        return std::all_of(csg->parts.begin(), csg->parts.end(), bounded);
    case CsgOperation::intersect:
        return std::any_of(csg->parts.begin(), csg->parts.end(), bounded);
    case CsgOperation::subtract:
        return csg->parts.empty() || bounded(csg->parts.front());
    }
    throw InternalError("a CSG operation without a meaning");
}

bool has_formula(const OccluderShape& shape) {
    const auto* csg = std::get_if<CsgShape>(&shape.solid);
    if (!csg) {
        return !std::holds_alternative<MeshShape>(shape.solid) &&
               !std::holds_alternative<VdbShape>(shape.solid);
    }
    return std::all_of(csg->parts.begin(), csg->parts.end(),
                       [](const CsgPart& part) { return has_formula(part.shape); });
}

Field field_of(const Occluder& occluder) {
    const Field fallback{has_formula(occluder.shape) ? FieldKind::exact : FieldKind::adaptive,
                         Field{}.resolution};
    return occluder.field.value_or(fallback);
}

std::filesystem::path recipe_folder(const Recipe& recipe) {
    return std::filesystem::path(recipe.file).parent_path();
}

std::filesystem::path mesh_path(const Recipe& recipe) {
    return recipe_folder(recipe) / recipe.mesh;
}

const Occluder* find_occluder(const Recipe& recipe, const std::string& name) {
    const auto found = std::find_if(recipe.occluders.begin(), recipe.occluders.end(),
                                    [&](const Occluder& occluder) { return occluder.name == name; });
    return found == recipe.occluders.end() ? nullptr : &*found;
}

std::vector<OccluderUse> occluders_of(const Recipe& recipe, const Edit& edit) {
    std::vector<OccluderUse> uses;
    if (!edit.occluders) {
        for (const Occluder& occluder : recipe.occluders) {
            uses.push_back({occluder.name, occluder.transform, occluder.influence, {}});
        }
        return uses;
    }
    for (const OccluderUse& use : *edit.occluders) {
        const Occluder* occluder = find_occluder(recipe, use.name);
        if (!occluder) {
            throw InternalError("an edit uses the unknown occluder \"" + use.name + "\"");
        }
        uses.push_back({use.name, use.transform.value_or(occluder->transform),
                        use.influence.value_or(occluder->influence), use.motion});
    }
    return uses;
}

} // namespace anvil
