// What a run of the benchmark was measured on.
#pragma once

#include "engine/deform/backend.h"

#include <cstdint>
#include <string>

namespace anvil {

struct Machine {
    std::string cpu;
    unsigned cores = 0; ///< that this program may use
    uint64_t memory_bytes = 0;
    std::string system;   ///< kernel and processor family
    std::string compiler; ///< of this program, and whether it was optimized
    std::string version;  ///< of Anvil
    std::string device;   ///< of the back end that was measured
    std::string driver;
    std::string float_loop; ///< what the float yardsticks are compiled for
    double load = 0;        ///< processes that wanted a core in the minute before
};

Machine this_machine(const Backend& tested);

} // namespace anvil
