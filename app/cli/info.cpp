#include "app/cli/command.h"
#include "app/cli/mesh_summary.h"
#include "engine/mesh/mesh_reader.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace anvil {

void add_info(CLI::App& program, CommandContext& context) {
    struct Options {
        std::string mesh;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(program, "info", "Say what a mesh file holds and what is wrong with it",
                                    "anvil info hand.ply --json");
    command->add_option("mesh", options->mesh, "Mesh file: .obj, .ply, .stl, .off")->required();
    command->add_flag("--json", options->json, "As JSON, with stable keys");
    command->callback([options, &context] {
        const Mesh mesh = read_mesh(options->mesh, context.log);
        const MeshHealth health = examine(mesh);
        write_text("", options->json ? summary_json(options->mesh, mesh, health, context.log)
                                     : summary_table(options->mesh, mesh, health));
    });
}

} // namespace anvil
