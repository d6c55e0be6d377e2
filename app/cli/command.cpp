#include "app/cli/command.h"

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

#include <CLI/CLI.hpp>
#include <iostream>

namespace anvil {

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example) {
    CLI::App* command = program.add_subcommand(name, description);
    command->set_version_flag("--version", "anvil " ANVIL_VERSION, "Print the version and exit");
    command->footer("Example:\n  " + example);
    return command;
}

void write_text(const std::string& path, const std::string& text) {
    if (!path.empty()) {
        write_file_atomically(path, text);
        return;
    }
    std::cout << text << std::flush;
    if (!std::cout) {
        throw WriteError("standard output cannot be written");
    }
}

} // namespace anvil
