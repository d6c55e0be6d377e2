#include "app/cli/command.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace anvil {

void add_sample(CLI::App& program, CommandContext& /*context*/) {
    struct Options {
        std::string shape;
        std::string output;
        size_t vertices = 10000;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(program, "sample", "Make a sample mesh",
                                    "anvil sample hand -o hand.ply --vertices 20000");
    std::string shapes;
    for (const std::string& name : sample_shape_names()) {
        shapes += (shapes.empty() ? "" : ", ") + name;
    }
    command->add_option("shape", options->shape, "One of " + shapes)->required();
    command->add_option("-o,--output", options->output, "Mesh file: .obj, .ply, .stl, .off")->required();
    command->add_option("--vertices", options->vertices, "About how many (within 10 %)")
        ->capture_default_str();
    command->callback([options] {
        const Mesh mesh = make_sample(options->shape, options->vertices);
        write_mesh(options->output, mesh, mesh.positions);
    });
}

} // namespace anvil
