// The program's commands: each adds itself to the argument parser and runs as the parser's callback.
#pragma once

#include "engine/core/log.h"
#include "engine/core/progress.h"

#include <string>

namespace CLI {
class App;
}

namespace anvil {

/// What every command is given. Warnings are printed when the command ends, however it ends.
struct CommandContext {
    Log log;
    Progress progress;
};

// Each adds one command. `context` outlives the parser; the commands throw what the engine throws.
void add_forge(CLI::App& program, CommandContext& context);
void add_info(CLI::App& program, CommandContext& context);
void add_distance(CLI::App& program, CommandContext& context);
void add_probe(CLI::App& program, CommandContext& context);
void add_sample(CLI::App& program, CommandContext& context);
void add_devices(CLI::App& program, CommandContext& context);
void add_selftest(CLI::App& program, CommandContext& context);
/// view, bake, bench: announced, not there yet.
void add_later_commands(CLI::App& program);

/// A command with --help, --version and an example below its help.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description,
                      const std::string& example);

/// Writes to the file, whole or not at all, or to stdout where `path` is empty. @throws WriteError
void write_text(const std::string& path, const std::string& text);

} // namespace anvil
