#include "app/backend_choice.h"
#include "app/cli/command.h"
#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"
#include "engine/occluder/level_set_file.h"
#include "engine/occluder/solid.h"

#include <algorithm>
#include <memory>

namespace anvil {

namespace {

struct Options {
    std::string recipe;
    std::string output;
    std::string occluder;
    std::string device = "auto";
};

std::string names_of(const Recipe& recipe) {
    std::string names;
    for (const Occluder& occluder : recipe.occluders) {
        names += (names.empty() ? "\"" : ", \"") + occluder.name + "\"";
    }
    return names;
}

const Occluder& chosen_occluder(const Recipe& recipe, const std::string& name) {
    if (recipe.occluders.empty()) {
        throw InputError(recipe.file + ": has no occluder to bake; add \"occluders\"");
    }
    if (name.empty()) {
        if (recipe.occluders.size() > 1) {
            throw InputError(recipe.file +
                             ": has several occluders; choose one by --occluder: " + names_of(recipe));
        }
        return recipe.occluders.front();
    }
    const Occluder* found = find_occluder(recipe, name);
    if (found == nullptr) {
        throw InputError(recipe.file + ": has no occluder \"" + name + "\"; it has " + names_of(recipe));
    }
    return *found;
}

void bake_occluder(const Recipe& recipe, const Occluder& occluder, const std::string& output,
                   SearchDevice* device, CommandContext& context) {
    const uint32_t resolution = field_of(occluder).resolution;
    try {
        const auto solid = true_distance(occluder.shape, {recipe_folder(recipe), &context.log},
                                         static_cast<int>(resolution));
        const Vec3 extent = solid->bounds().high - solid->bounds().low;
        const double voxel = occluder.transform.scale * std::max({extent.x, extent.y, extent.z}) / resolution;
        write_level_set(output, *placed(solid, occluder.transform), voxel, context.progress, device);
    } catch (const InputError& error) {
        throw InputError(recipe.file + ": occluder \"" + occluder.name + "\": " + error.what());
    }
}

} // namespace

void add_bake(Program& program, CommandContext& context) {
    auto options = std::make_shared<Options>();
    Command command = program.add_command(
        "bake", "Write an occluder's distance field, at its place, as an OpenVDB level set",
        "anvil bake grip.json -o ball.vdb --occluder ball");
    command.positional("recipe", options->recipe, "Recipe file (JSON)");
    command.required_option("-o,--output", options->output, "Level set file: .vdb");
    command.option("--occluder", options->occluder, "Which one, where the recipe has several");
    command.option("--device", options->device,
                   "auto (a GPU, where there is one), cpu, or a Vulkan device by name or index");
    command.run([options, &context] {
        if (!options->output.ends_with(".vdb")) {
            throw InputError("-o " + options->output + ": a level set's file name ends in .vdb");
        }
        const Recipe recipe = read_recipe(options->recipe);
        const Occluder& occluder = chosen_occluder(recipe, options->occluder);
        const ChosenSearch device = choose_search(options->device, context.log);
        bake_occluder(recipe, occluder, options->output, device.get(), context);
        check_validation(device.device);
    });
}

} // namespace anvil
