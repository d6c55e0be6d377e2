// Recipes that the program refuses.
#pragma once

#include "tests/app/forge_folder.h"

#include <string>
#include <vector>

namespace anvil {

struct RefusedRecipe {
    std::string what;
    std::string recipe;
    std::vector<std::string> shown; ///< the message holds all of these
};

/// Forges it: status 2, nothing on the output, and a message that says what it should.
void check_refused(const ForgeFolder& folder, const RefusedRecipe& bad);

} // namespace anvil
