// The program's commands and their arguments. Only command.cpp knows the parser: its header takes long to
// compile.
#pragma once

#include "engine/core/log.h"
#include "engine/core/progress.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace anvil {

/// One command's arguments; what is given is stored when the command line is parsed. The values outlive the
/// program object (the commands keep them in what they pass to run()). `names`: "-o,--output".
class Command {
  public:
    explicit Command(CLI::App& app) : app_(app) {}

    /// Required, by its place.
    void positional(const std::string& name, std::string& value, const std::string& help);
    void optional_positional(const std::string& name, std::string& value, const std::string& help);
    void option(const std::string& names, std::string& value, const std::string& help);
    void required_option(const std::string& names, std::string& value, const std::string& help);
    /// One of `choices`.
    void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
                const std::string& help);
    void number(const std::string& names, std::optional<double>& value, const std::string& help);
    void count(const std::string& names, size_t& value, const std::string& help);
    /// At least once, one value each time.
    void repeated(const std::string& names, std::vector<std::string>& values, const std::string& help);
    void flag(const std::string& names, bool& value, const std::string& help);

    /// What the command does, once its arguments are known.
    void run(std::function<void()> action);

  private:
    CLI::App& app_;
};

class Program {
  public:
    Program();
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// A command with --help, --version and an example below its help.
    Command add_command(const std::string& name, const std::string& description, const std::string& example);

    /// Parses and runs the command, or prints help or version.
    /// @throws InputError for arguments that are not understood, and what the command throws.
    void run(int argc, char** argv);

  private:
    std::unique_ptr<CLI::App> app_;
};

/// What every command is given. Warnings are printed when the command ends, however it ends.
struct CommandContext {
    Log log;
    Progress progress;
};

// Each adds one command. `context` outlives the program; the commands throw what the engine throws.
void add_forge(Program& program, CommandContext& context);
void add_info(Program& program, CommandContext& context);
void add_distance(Program& program, CommandContext& context);
void add_probe(Program& program, CommandContext& context);
void add_bake(Program& program, CommandContext& context);
void add_sample(Program& program, CommandContext& context);
void add_devices(Program& program, CommandContext& context);
void add_selftest(Program& program, CommandContext& context);
void add_bench(Program& program, CommandContext& context);
void add_view(Program& program, CommandContext& context);

/// Writes to the file, whole or not at all, or to stdout where `path` is empty. @throws WriteError
void write_text(const std::string& path, const std::string& text);

} // namespace anvil
