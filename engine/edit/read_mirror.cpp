#include "engine/edit/recipe_parts.h"

namespace anvil {

Mirror read_mirror(const JsonReader& mirror) {
    mirror.check_keys({"axis", "origin", "merge"});
    Mirror result;
    result.axis = mirror.required("axis").word<int>({{"x", 0}, {"y", 1}, {"z", 2}});
    if (const auto origin = mirror.find("origin")) {
        result.origin = origin->number();
    }
    if (const auto merge = mirror.find("merge")) {
        result.merge = merge->positive();
    }
    return result;
}

} // namespace anvil
