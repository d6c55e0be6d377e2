#include "engine/edit/recipe_json.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

Recipe with_mirror(const std::string& mirror) {
    return edit_recipe(
        "{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 0}, 'by': [0,0,1]} ], 'mirror': " + mirror +
        " }");
}

} // namespace

TEST_CASE("a mirror is read and written back") {
    const Recipe plain = with_mirror("{'axis': 'y'}");
    CHECK(plain.edits[0].mirror == Mirror{1, 0, {}});
    const Recipe full = with_mirror("{'axis': 'z', 'origin': -0.125, 'merge': 0.01}");
    CHECK(full.edits[0].mirror == Mirror{2, -0.125, 0.01});
    for (const Recipe& recipe : {plain, full}) {
        CHECK(parse_recipe(write_recipe(recipe), recipe.file) == recipe);
    }
}

TEST_CASE("a mirror that cannot be meant names its key") {
    CHECK_THROWS_WITH(with_mirror("{'origin': 0}"), Catch::Contains("mirror") && Catch::Contains("\"axis\""));
    CHECK_THROWS_WITH(with_mirror("{'axis': 'w'}"), Catch::Contains("mirror.axis"));
    CHECK_THROWS_WITH(with_mirror("{'axis': 'x', 'merge': 0}"), Catch::Contains("mirror.merge"));
    CHECK_THROWS_WITH(with_mirror("{'axis': 'x', 'plane': 0}"), Catch::Contains("mirror.plane"));
    CHECK_THROWS_WITH(
        recipe_of(
            "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': "
            "{'radius': 1}}} ], 'edits': [ {'kind': 'translate', 'handles': [], 'mirror': {'axis': 'x'}, "
            "'occluders': [ {'name': 'ball', 'motion': [{'at': 0}, {'at': 1, 'translate': [0,1,0]}]} ]} ] }"),
        Catch::Contains("mirror") && Catch::Contains("handles and anchors"));
}
