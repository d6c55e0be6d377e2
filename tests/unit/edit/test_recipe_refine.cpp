#include "tests/unit/edit/recipe_texts.h"

using namespace anvil;
using namespace anvil::recipe_texts;

namespace {

Refine refine_of(const std::string& text) {
    const Recipe recipe = parse(minimal(", \"refine\": " + text));
    REQUIRE(recipe.edits[0].refine);
    CHECK(parse(write_recipe(recipe)) == recipe);
    return *recipe.edits[0].refine;
}

} // namespace

TEST_CASE("refine takes a criterion, its tolerance and limits, and is written as it is read") {
    CHECK(refine_of("{}") == Refine{});
    const Refine shape = refine_of(
        R"({"criterion": "shape", "tolerance": 0.01, "min_edge": 0.5, "max_vertices": 70, "flip": true,
           "relax": true})");
    CHECK(shape.flip);
    CHECK(shape.relax);
    CHECK(shape.shape_tolerance == 0.01);
    CHECK(shape.min_edge == 0.5);
    CHECK(shape.max_vertices == 70U);
    CHECK(refine_of(R"({"criterion": "space", "tolerance": 3})").space_tolerance == 3);
    const Refine both = refine_of(R"({"criterion": "both", "tolerance": {"shape": 0.1, "space": 2}})");
    CHECK(both.criterion == RefineCriterion::both);
    CHECK(both.shape_tolerance == 0.1);
    CHECK(both.space_tolerance == 2);
    CHECK(!parse(minimal()).edits[0].refine);
}

TEST_CASE("what refine cannot mean is refused at its place") {
    const auto refuse = [](const std::string& text, const std::vector<std::string>& parts) {
        check_complaint(minimal(", \"refine\": " + text), parts);
    };
    refuse(R"({"criterion": "size"})", {"refine.criterion", "\"shape\"", "\"space\"", "\"both\""});
    refuse(R"({"criterion": "space"})", {"refine", "tolerance", "world units"});
    refuse(R"({"criterion": "both", "tolerance": 1})", {"refine.tolerance", "found 1"});
    refuse(R"({"tolerance": 0})", {"refine.tolerance", "found 0"});
    refuse(R"({"min_edge": -1})", {"refine.min_edge", "found -1"});
    refuse(R"({"max_vertices": 1.5})", {"refine.max_vertices", "found 1.5"});
    refuse(R"({"tolerence": 1})", {"tolerence", "tolerance"});
    refuse(R"({"relax": 3})", {"refine.relax", "found 3"});
    refuse(R"({"criterion": "space", "tolerance": 1}, "dilation": {"form": "depth", "amount": 1})",
           {"refine", "shape"});
}
