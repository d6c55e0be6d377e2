#include "app/cli/command.h"

#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <utility>

namespace anvil {

namespace {

const std::string version = "anvil " ANVIL_VERSION;

std::string message_of(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<std::string> unknown = program.remaining();
    if (program.get_subcommands().empty() && !unknown.empty()) {
        return "there is no command or option \"" + unknown.front() + "\" (see anvil --help)";
    }
    std::string command = "anvil";
    for (const CLI::App* used : program.get_subcommands()) {
        command += " " + used->get_name();
    }
    return std::string(error.what()) + " (see " + command + " --help)";
}

} // namespace

void Command::positional(const std::string& name, std::string& value, const std::string& help) {
    app_.add_option(name, value, help)->required();
}

void Command::optional_positional(const std::string& name, std::string& value, const std::string& help) {
    app_.add_option(name, value, help);
}

void Command::option(const std::string& names, std::string& value, const std::string& help) {
    app_.add_option(names, value, help)->capture_default_str();
}

void Command::required_option(const std::string& names, std::string& value, const std::string& help) {
    app_.add_option(names, value, help)->required();
}

void Command::choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
                     const std::string& help) {
    app_.add_option(names, value, help)->check(CLI::IsMember(choices))->capture_default_str();
}

void Command::number(const std::string& names, std::optional<double>& value, const std::string& help) {
    app_.add_option(names, value, help);
}

void Command::count(const std::string& names, size_t& value, const std::string& help) {
    app_.add_option(names, value, help)
        ->check([](const std::string& text) {
            // A negative number would wrap round to a huge one.
            return text.starts_with("-") ? "found " + text + "; give a whole number, not negative"
                                         : std::string();
        })
        ->capture_default_str();
}

void Command::repeated(const std::string& names, std::vector<std::string>& values, const std::string& help) {
    app_.add_option(names, values, help)->required()->allow_extra_args(false);
}

void Command::flag(const std::string& names, bool& value, const std::string& help) {
    app_.add_flag(names, value, help);
}

void Command::run(std::function<void()> action) {
    app_.callback(std::move(action));
}

Program::Program()
    : app_(std::make_unique<CLI::App>("Deforms meshes with handles, past and around obstacles.", "anvil")) {
    app_->set_version_flag("--version", version, "Print the version and exit");
    app_->footer("Example:\n  anvil sample hand -o hand.ply && anvil info hand.ply\n\n"
                 "Exit status: 0 done, 2 the input, 3 the device, 4 could not write, 1 a fault of Anvil, "
                 "130 interrupted.");
    app_->require_subcommand(1);
}

Program::~Program() = default;

Command Program::add_command(const std::string& name, const std::string& description,
                             const std::string& example) {
    CLI::App* command = app_->add_subcommand(name, description);
    command->set_version_flag("--version", version, "Print the version and exit");
    command->footer("Example:\n  " + example);
    return Command(*command);
}

void Program::run(int argc, char** argv) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        app_->exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        throw InputError(message_of(*app_, error));
    }
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
