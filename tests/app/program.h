// Runs the built program as a person would and keeps what came out of it.
#pragma once

#include <string>
#include <vector>

namespace anvil {

struct ProgramRun {
    int status = -1; ///< exit status; 128 + number if a signal ended it
    std::string out;
    std::string err;
    double seconds = 0;      ///< wall time
    long peak_kilobytes = 0; ///< largest resident set
};

struct RunLimits {
    double seconds = 120; ///< killed beyond
    /// Address space; 0: any. Sanitizers reserve terabytes: there it is not applied.
    size_t address_space = 0;
    double interrupt_after = 0;           ///< seconds after which SIGINT is sent; 0: never
    std::vector<std::string> environment; ///< "NAME=value" in front of the test's own
    std::string folder;                   ///< working folder; empty: the test's own
};

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool under_sanitizers = true;
#else
inline constexpr bool under_sanitizers = false;
#endif

/// Runs `anvil ARGUMENTS...` with no standard input; a test failure if it cannot be started.
ProgramRun run_anvil(const std::vector<std::string>& arguments, const RunLimits& limits = {});

/// Content of a file; a test failure if it cannot be read.
std::string content_of(const std::string& path);

/// Whether every line of `text` begins with `prefix`; true of an empty text.
bool all_lines_begin_with(const std::string& text, const std::string& prefix);

} // namespace anvil
