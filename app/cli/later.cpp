#include "app/cli/command.h"
#include "engine/core/error.h"

#include <CLI/CLI.hpp>

namespace anvil {

namespace {

void add_later(CLI::App& program, const std::string& name, const std::string& description) {
    CLI::App* command = program.add_subcommand(name, description + " (not yet)");
    command->allow_extras();
    command->group("To come");
    command->callback([name] {
        throw InputError("anvil " + name + " is announced but not yet there; see anvil --help for what is");
    });
}

} // namespace

void add_later_commands(CLI::App& program) {
    add_later(program, "view", "Open a mesh or recipe in a window");
    add_later(program, "bake", "Write an occluder's distance field as a VDB level set");
    add_later(program, "bench", "Measure this machine");
}

} // namespace anvil
