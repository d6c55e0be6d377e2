// The program `anvil`: arguments in, exit status out. Errors are caught here and nowhere else.
#include "app/cli/command.h"
#include "app/cli/progress_bar.h"
#include "engine/core/error.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>

namespace {

std::atomic<anvil::Progress*> interruptible{nullptr};

// The first interrupt asks the work to stop, which leaves no half-written file; a second one ends the
// program.
void on_interrupt(int) {
    if (anvil::Progress* progress = interruptible.load()) {
        progress->cancel();
    }
}

void listen_for_interrupts(anvil::Progress& progress) {
    interruptible = &progress;
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
}

int fail(int status, const std::string& message) {
    std::cerr << "anvil: error: " << message << "\n";
    return status;
}

std::string parse_message(const CLI::App& program, const CLI::ParseError& error) {
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

int run(CLI::App& program, int argc, char** argv) {
    try {
        program.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& help_or_version) {
        return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return fail(2, parse_message(program, error));
    } catch (const anvil::InputError& error) {
        return fail(2, error.what());
    } catch (const anvil::DeviceError& error) {
        return fail(3, error.what());
    } catch (const anvil::WriteError& error) {
        return fail(4, error.what());
    } catch (const anvil::Cancelled& error) {
        return fail(130, error.what());
    } catch (const std::bad_alloc&) {
        return fail(1, "out of memory");
    } catch (const std::exception& error) {
        return fail(1, std::string("a fault of Anvil: ") + error.what());
    }
}

} // namespace

int main(int argc, char** argv) {
    std::ios::sync_with_stdio(false);
    anvil::CommandContext context{{}, anvil::Progress(anvil::progress_bar())};
    listen_for_interrupts(context.progress);

    CLI::App program("Deforms meshes with handles, past and around obstacles.", "anvil");
    program.set_version_flag("--version", "anvil " ANVIL_VERSION, "Print the version and exit");
    program.footer("Example:\n  anvil sample hand -o hand.ply && anvil info hand.ply\n\n"
                   "Exit status: 0 done, 2 the input, 3 the device, 4 could not write, 1 a fault of Anvil, "
                   "130 interrupted.");
    program.require_subcommand(1);
    anvil::add_forge(program, context);
    anvil::add_info(program, context);
    anvil::add_distance(program, context);
    anvil::add_probe(program, context);
    anvil::add_sample(program, context);
    anvil::add_devices(program, context);
    anvil::add_selftest(program, context);
    anvil::add_later_commands(program);

    const int status = run(program, argc, argv);
    anvil::clear_progress_bar();
    for (const std::string& warning : context.log.warnings) {
        std::cerr << "anvil: warning: " << warning << "\n";
    }
    return status;
}
