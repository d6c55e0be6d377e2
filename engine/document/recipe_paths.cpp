#include "engine/document/recipe_paths.h"

#include <algorithm>
#include <functional>

namespace anvil {

namespace fs = std::filesystem;

namespace {

using Visit = std::function<void(std::string&)>;

void visit_files(OccluderShape& shape, const Visit& visit) {
    if (auto* mesh = std::get_if<MeshShape>(&shape.solid)) {
        visit(mesh->file);
    } else if (auto* vdb = std::get_if<VdbShape>(&shape.solid)) {
        visit(vdb->file);
    } else if (auto* csg = std::get_if<CsgShape>(&shape.solid)) {
        for (CsgPart& part : csg->parts) {
            visit_files(part.shape, visit);
        }
    }
}

void visit_files(Recipe& recipe, const Visit& visit) {
    visit(recipe.mesh);
    for (Occluder& occluder : recipe.occluders) {
        visit_files(occluder.shape, visit);
    }
}

/// With the links in its folder's name followed; the file itself may be one, which keeps its name.
fs::path resolved(const fs::path& path) {
    std::error_code failed;
    const fs::path absolute = fs::absolute(path).lexically_normal();
    const fs::path folder = fs::weakly_canonical(absolute.parent_path(), failed);
    return failed ? absolute : folder / absolute.filename();
}

} // namespace

Recipe with_absolute_paths(Recipe recipe) {
    const fs::path folder = fs::absolute(recipe_folder(recipe));
    visit_files(recipe, [&](std::string& file) { file = (folder / file).lexically_normal().string(); });
    return recipe;
}

Recipe with_paths_from(Recipe recipe, const fs::path& folder) {
    std::error_code failed;
    const fs::path canonical = fs::weakly_canonical(fs::absolute(folder), failed);
    const fs::path base = failed ? fs::absolute(folder).lexically_normal() : canonical;
    visit_files(recipe,
                [&](std::string& file) { file = resolved(file).lexically_proximate(base).generic_string(); });
    return recipe;
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) ||
           fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

bool reads(const Recipe& recipe, const fs::path& file) {
    bool found = false;
    Recipe copy = recipe;
    visit_files(copy, [&](std::string& used) { found = found || same_file(used, file); });
    return found;
}

} // namespace anvil
