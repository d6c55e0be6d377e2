#include "engine/edit/recipe_parts.h"

#include <nlohmann/json.hpp>

namespace anvil {

namespace {

void read_tolerances(const JsonReader& refine, Refine& result) {
    const bool shape = result.criterion != RefineCriterion::space;
    const bool space = result.criterion != RefineCriterion::shape;
    const auto tolerance = refine.find("tolerance");
    if (!tolerance) {
        if (space) {
            refine.fail("the criteria \"space\" and \"both\" need a \"tolerance\" in world units, e.g. "
                        "\"tolerance\": 0.01, or {\"shape\": 0.001, \"space\": 0.01} for \"both\"");
        }
        return;
    }
    if (shape && space) {
        tolerance->check_keys({"shape", "space"});
        result.shape_tolerance = tolerance->required("shape").positive();
        result.space_tolerance = tolerance->required("space").positive();
    } else {
        (shape ? result.shape_tolerance : result.space_tolerance) = tolerance->positive();
    }
}

} // namespace

Refine read_refine(const JsonReader& refine) {
    refine.check_keys({"criterion", "tolerance", "min_edge", "max_vertices", "flip", "relax"});
    Refine result;
    if (const auto criterion = refine.find("criterion")) {
        result.criterion = criterion->word<RefineCriterion>({{"shape", RefineCriterion::shape},
                                                             {"space", RefineCriterion::space},
                                                             {"both", RefineCriterion::both}});
    }
    read_tolerances(refine, result);
    if (const auto min_edge = refine.find("min_edge")) {
        result.min_edge = min_edge->within(0, std::numeric_limits<double>::max());
    }
    if (const auto max_vertices = refine.find("max_vertices")) {
        result.max_vertices = max_vertices->whole(0, no_index - 1);
    }
    if (const auto flip = refine.find("flip")) {
        result.flip = flip->boolean();
    }
    if (const auto relax = refine.find("relax")) {
        result.relax = relax->boolean();
    }
    return result;
}

nlohmann::ordered_json written(const Refine& refine) {
    nlohmann::ordered_json result;
    switch (refine.criterion) {
    case RefineCriterion::shape:
        result = {{"criterion", "shape"}, {"tolerance", refine.shape_tolerance}};
        break;
    case RefineCriterion::space:
        result = {{"criterion", "space"}, {"tolerance", refine.space_tolerance}};
        break;
    case RefineCriterion::both:
        result = {{"criterion", "both"},
                  {"tolerance", {{"shape", refine.shape_tolerance}, {"space", refine.space_tolerance}}}};
        break;
    }
    result["min_edge"] = refine.min_edge;
    if (refine.max_vertices) {
        result["max_vertices"] = *refine.max_vertices;
    }
    if (refine.flip) {
        result["flip"] = true;
    }
    if (refine.relax) {
        result["relax"] = true;
    }
    return result;
}

} // namespace anvil
