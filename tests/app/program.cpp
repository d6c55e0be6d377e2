#include "tests/app/program.h"

#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace anvil {

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (std::string& text : texts) {
        result.push_back(text.data());
    }
    result.push_back(nullptr);
    return result;
}

// Between fork and exec: system calls alone.
[[noreturn]] void become_program(char* const* arguments, char* const* environment, const char* out,
                                 const char* err, const RunLimits& limits) {
    const int none = open("/dev/null", O_RDONLY);
    const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_file = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    bool ready = dup2(none, STDIN_FILENO) >= 0 && dup2(out_file, STDOUT_FILENO) >= 0 &&
                 dup2(err_file, STDERR_FILENO) >= 0;
    if (!limits.folder.empty()) {
        ready = ready && chdir(limits.folder.c_str()) == 0;
    }
    if (limits.address_space > 0 && !under_sanitizers) {
        const rlimit bound{limits.address_space, limits.address_space};
        ready = ready && setrlimit(RLIMIT_AS, &bound) == 0;
    }
    if (ready) {
        execve(arguments[0], arguments, environment);
    }
    _exit(127);
}

int wait_for(pid_t child, const RunLimits& limits, Clock::time_point start, rusage& usage) {
    int state = 0;
    bool interrupted = false;
    while (wait4(child, &state, WNOHANG, &usage) == 0) {
        if (!interrupted && limits.interrupt_after > 0 && since(start) > limits.interrupt_after) {
            kill(child, SIGINT);
            interrupted = true;
        }
        if (since(start) > limits.seconds) {
            kill(child, SIGKILL);
            wait4(child, &state, 0, &usage);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

} // namespace

ProgramRun run_anvil(const std::vector<std::string>& arguments, const RunLimits& limits) {
    const ScratchFolder scratch;
    const std::string out = scratch / "out";
    const std::string err = scratch / "err";
    std::vector<std::string> command{ANVIL_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<std::string> environment = limits.environment;
    environment.emplace_back("ANVIL_CACHE=off"); // tests leave nothing in the user's folders
    for (char** entry = environ; *entry != nullptr; ++entry) {
        environment.emplace_back(*entry);
    }
    const std::vector<char*> argument_pointers = pointers(command);
    const std::vector<char*> environment_pointers = pointers(environment);

    const auto start = Clock::now();
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        become_program(argument_pointers.data(), environment_pointers.data(), out.c_str(), err.c_str(),
                       limits);
    }
    ProgramRun run;
    rusage usage{};
    run.status = wait_for(child, limits, start, usage);
    run.seconds = since(start);
    run.peak_kilobytes = usage.ru_maxrss;
    run.out = content_of(out);
    run.err = content_of(err);
    REQUIRE(run.status != 127);
    return run;
}

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    INFO(path);
    REQUIRE(file);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

bool all_lines_begin_with(const std::string& text, const std::string& prefix) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(prefix)) {
            return false;
        }
    }
    return true;
}

} // namespace anvil
