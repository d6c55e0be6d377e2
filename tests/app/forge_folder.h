// A folder with a mesh and a recipe, to forge in.
#pragma once

#include "engine/mesh/mesh.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <string>
#include <vector>

namespace anvil {

/// Holds mesh.ply, the unit sphere with 1002 vertices, and whatever else a test puts in.
class ForgeFolder {
  public:
    ForgeFolder();

    std::string path(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& text) const;
    bool has(const std::string& name) const;
    Mesh mesh(const std::string& name) const;

    /// Runs `anvil forge` here with these arguments.
    ProgramRun forge(const std::vector<std::string>& arguments) const;
    /// The same with a recipe text, on the CPU, to out.ply.
    ProgramRun forge_recipe(const std::string& recipe) const;

  private:
    ScratchFolder folder_;
};

/// A recipe on mesh.ply with these edits and occluders (JSON lists).
std::string recipe_text(const std::string& edits, const std::string& occluders = "[]");

/// The sphere's top pulled up by half a radius.
std::string pull_edit();

} // namespace anvil
