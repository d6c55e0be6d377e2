#include "tests/app/refused_recipe.h"

#include <catch2/catch.hpp>

namespace anvil {

void check_refused(const ForgeFolder& folder, const RefusedRecipe& bad) {
    INFO(bad.what);
    const ProgramRun run = folder.forge_recipe(bad.recipe);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK_THAT(run.err, Catch::StartsWith("anvil: error: "));
    for (const std::string& shown : bad.shown) {
        CHECK_THAT(run.err, Catch::Contains(shown));
    }
}

} // namespace anvil
