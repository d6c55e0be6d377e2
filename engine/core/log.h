// Warnings are collected, not printed: the engine does not own the terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace anvil {

/// What the user should know although the work went on. Each entry is one sentence without a prefix.
struct Log {
    std::vector<std::string> warnings;

    void warn(std::string message) { warnings.push_back(std::move(message)); }
};

} // namespace anvil
