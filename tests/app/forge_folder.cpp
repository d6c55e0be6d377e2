#include "tests/app/forge_folder.h"

#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"

#include <filesystem>
#include <fstream>

namespace anvil {

ForgeFolder::ForgeFolder() {
    const Mesh sphere = make_sample("icosphere", 1002);
    write_mesh(path("mesh.ply"), sphere, sphere.positions);
}

void ForgeFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
}

bool ForgeFolder::has(const std::string& name) const {
    return std::filesystem::exists(path(name));
}

Mesh ForgeFolder::mesh(const std::string& name) const {
    Log ignored;
    return read_mesh(path(name), ignored);
}

ProgramRun ForgeFolder::forge(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"forge"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    RunLimits here;
    here.folder = folder_.path();
    return run_anvil(all, here);
}

ProgramRun ForgeFolder::forge_recipe(const std::string& recipe) const {
    write("recipe.json", recipe);
    return forge({"recipe.json", "--device", "cpu", "-o", "out.ply"});
}

std::string recipe_text(const std::string& edits, const std::string& occluders) {
    return R"({"anvil": 1, "mesh": "mesh.ply", "occluders": )" + occluders + R"(, "edits": )" + edits + "}";
}

std::string pull_edit() {
    return R"([{"kind": "translate", "radius": 0.8,
                "handles": [{"at": {"nearest": [0, 1, 0]}, "by": [0, 0.5, 0]}]}])";
}

} // namespace anvil
