#include "engine/edit/recipe_parts.h"

namespace anvil {

Dilation read_dilation(const JsonReader& dilation) {
    dilation.check_keys({"form", "amount", "solve", "width"});
    Dilation result;
    result.form = dilation.required("form").word<DilationForm>(
        {{"depth", DilationForm::depth}, {"volume", DilationForm::volume}});
    if (const auto solve = dilation.find("solve")) {
        result.solve = solve->boolean();
    }
    if (result.solve && result.form == DilationForm::depth) {
        dilation.required("solve").fail(
            "the depth form knows no volume to solve for; use \"form\": \"volume\"");
    }
    if (result.solve == dilation.has("amount")) {
        dilation.fail("give either \"amount\" or, in the volume form, \"solve\": true");
    }
    if (const auto amount = dilation.find("amount")) {
        constexpr double most = 100;
        result.amount = amount->within(0, most);
    }
    if (const auto width = dilation.find("width")) {
        result.width = width->positive();
    }
    return result;
}

} // namespace anvil
