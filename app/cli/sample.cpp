#include "app/cli/command.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"

#include <memory>

namespace anvil {

void add_sample(Program& program, CommandContext& /*context*/) {
    struct Options {
        std::string shape;
        std::string output;
        size_t vertices = 10000;
    };
    auto options = std::make_shared<Options>();
    Command command =
        program.add_command("sample", "Make a sample mesh", "anvil sample hand -o hand.ply --vertices 20000");
    std::string shapes;
    for (const std::string& name : sample_shape_names()) {
        shapes += (shapes.empty() ? "" : ", ") + name;
    }
    command.positional("shape", options->shape, "One of " + shapes);
    command.required_option("-o,--output", options->output, "Mesh file: .obj, .ply, .stl, .off");
    command.count("--vertices", options->vertices, "About how many (within 10 %)");
    command.run([options] {
        const Mesh mesh = make_sample(options->shape, options->vertices);
        write_mesh(options->output, mesh, mesh.positions);
    });
}

} // namespace anvil
