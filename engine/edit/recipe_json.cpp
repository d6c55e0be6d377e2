#include "engine/edit/recipe_json.h"

#include "engine/core/error.h"
#include "engine/edit/recipe_parts.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace anvil {

namespace {

std::vector<std::string> occluder_names(const Recipe& recipe) {
    std::vector<std::string> names;
    for (const Occluder& occluder : recipe.occluders) {
        names.push_back(occluder.name);
    }
    return names;
}

void read_occluders(const JsonReader& list, Recipe& recipe) {
    for (const JsonReader& item : list.items()) {
        Occluder occluder = read_occluder(item);
        if (find_occluder(recipe, occluder.name)) {
            item.required("name").fail_found("another occluder has this name; give each its own");
        }
        recipe.occluders.push_back(std::move(occluder));
    }
}

void check_names(const JsonReader& edit, const Edit& parsed, const Recipe& recipe) {
    if (!parsed.occluders) {
        return;
    }
    const std::vector<JsonReader> uses = edit.required("occluders").items();
    for (size_t i = 0; i < uses.size(); ++i) {
        const std::string& name = (*parsed.occluders)[i].name;
        if (find_occluder(recipe, name)) {
            continue;
        }
        std::string known;
        for (const std::string& other : occluder_names(recipe)) {
            known += (known.empty() ? "\"" : ", \"") + other + "\"";
        }
        uses[i].fail("unknown occluder \"" + name + "\"; " +
                     (known.empty() ? "the recipe has no \"occluders\"" : "the recipe has " + known));
    }
}

// `paper` takes equal steps without contact: nothing of it can be shared with the other influences.
void check_influences(const JsonReader& edit, const Edit& parsed, const Recipe& recipe) {
    const std::vector<OccluderUse> uses = occluders_of(recipe, parsed);
    const auto papers = std::count_if(uses.begin(), uses.end(), [](const OccluderUse& use) {
        return use.influence->kind == InfluenceKind::paper;
    });
    if (papers > 0 && papers < static_cast<std::ptrdiff_t>(uses.size())) {
        edit.fail("the influence \"paper\" cannot be mixed with others in one edit; choose by \"occluders\": "
                  "[...]");
    }
    if (papers > 0 && parsed.dilation) {
        edit.required("dilation")
            .fail("the influence \"paper\" has no contact that could dilate; use \"hard\" or "
                  "\"soft\", or remove this");
    }
    if (papers > 0 && parsed.steps && parsed.steps->adaptive) {
        edit.required("steps").fail("the influence \"paper\" takes equal steps; give \"count\"");
    }
}

void read_edits(const JsonReader& list, Recipe& recipe) {
    for (const JsonReader& item : list.items()) {
        recipe.edits.push_back(read_edit(item));
        check_names(item, recipe.edits.back(), recipe);
        check_influences(item, recipe.edits.back(), recipe);
    }
}

std::string read_text(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        throw InputError(path.string() + ": there is no such recipe file");
    }
    if (std::filesystem::is_directory(status)) {
        throw InputError(path.string() + ": this is a folder; give the recipe's JSON file");
    }
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.is_open() || file.bad()) {
        throw InputError(path.string() + ": the recipe cannot be read; check its permissions");
    }
    return text;
}

} // namespace

Recipe parse_recipe(const std::string& text, const std::string& file_name) {
    const nlohmann::json document = parse_json(text, file_name);
    const JsonReader root(document, file_name);
    root.check_keys({"anvil", "mesh", "occluders", "edits"});
    if (const JsonReader version = root.required("anvil"); version.number() != 1) {
        version.fail_found("this program reads recipes of version 1");
    }
    Recipe recipe;
    recipe.file = file_name;
    const JsonReader mesh = root.required("mesh");
    recipe.mesh = mesh.text();
    if (recipe.mesh.empty()) {
        mesh.fail_found("must be the path of a mesh file, relative to the recipe");
    }
    if (const auto occluders = root.find("occluders")) {
        read_occluders(*occluders, recipe);
    }
    read_edits(root.required("edits"), recipe);
    return recipe;
}

Recipe read_recipe(const std::filesystem::path& path) {
    return parse_recipe(read_text(path), path.string());
}

} // namespace anvil
