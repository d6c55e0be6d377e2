// The program `anvil`: arguments in, exit status out. Errors are caught here and nowhere else.
#include "app/cli/command.h"
#include "app/cli/progress_bar.h"
#include "engine/core/error.h"

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

int run(anvil::Program& program, int argc, char** argv) {
    try {
        program.run(argc, argv);
        return 0;
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

    anvil::Program program;
    anvil::add_forge(program, context);
    anvil::add_info(program, context);
    anvil::add_distance(program, context);
    anvil::add_probe(program, context);
    anvil::add_bake(program, context);
    anvil::add_sample(program, context);
    anvil::add_devices(program, context);
    anvil::add_selftest(program, context);
    anvil::add_bench(program, context);
    anvil::add_view(program, context);

    const int status = run(program, argc, argv);
    anvil::clear_progress_bar();
    for (const std::string& warning : context.log.warnings) {
        std::cerr << "anvil: warning: " << warning << "\n";
    }
    return status;
}
