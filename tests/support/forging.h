// Forging recipes given as text, on meshes made in memory.
#pragma once

#include "engine/edit/recipe_json.h"
#include "engine/forge/forge.h"
#include "engine/mesh/sample_shapes.h"

#include <string>

namespace anvil::test {

/// Replaces ' by " so that recipes read well in C++.
inline Recipe recipe_of(std::string text) {
    for (char& c : text) {
        c = c == '\'' ? '"' : c;
    }
    return parse_recipe(text, "test.json");
}

/// A recipe of one edit without occluders.
inline Recipe edit_recipe(const std::string& edit) {
    return recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'edits': [ " + edit + " ] }");
}

inline ForgeResult forged(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log) {
    Progress progress;
    return forge(mesh, recipe, backend, log, progress);
}

inline ForgeResult forged_on_cpu(const Mesh& mesh, const Recipe& recipe) {
    Log log;
    const auto cpu = make_cpu_backend();
    return forged(mesh, recipe, *cpu, log);
}

/// 17 digits, so that the recipe holds the number exactly.
std::string text(double x);
std::string text(const Vec3& v);

/// Vertex nearest to a point.
uint32_t nearest_vertex(const Mesh& mesh, const Vec3& p);

} // namespace anvil::test
