#include "app/cli/command.h"
#include "app/cli/mesh_summary.h"
#include "engine/mesh/mesh_reader.h"

#include <memory>

namespace anvil {

void add_info(Program& program, CommandContext& context) {
    struct Options {
        std::string mesh;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.add_command("info", "Say what a mesh file holds and what is wrong with it",
                                          "anvil info hand.ply --json");
    command.positional("mesh", options->mesh, "Mesh file: .obj, .ply, .stl, .off");
    command.flag("--json", options->json, "As JSON, with stable keys");
    command.run([options, &context] {
        const Mesh mesh = read_mesh(options->mesh, context.log);
        const MeshHealth health = examine(mesh);
        write_text("", options->json ? summary_json(options->mesh, mesh, health, context.log)
                                     : summary_table(options->mesh, mesh, health));
    });
}

} // namespace anvil
