#include "app/bench/machine.h"

#include <cstdlib>
#include <fstream>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace anvil {

namespace {

/// Of /proc/cpuinfo; where there is none, the processor family has to do.
std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

std::string system_name() {
    utsname names{};
    if (uname(&names) != 0) {
        return "unknown";
    }
    return std::string(names.sysname) + " " + names.release + " " + names.machine;
}

std::string compiler_name() {
#if defined(__clang__)
    std::string name = "clang " __clang_version__;
#elif defined(__GNUC__)
    std::string name = "g++ " __VERSION__;
#else
    std::string name = "unknown";
#endif
#if !defined(__OPTIMIZE__)
    name += ", not optimized";
#endif
    return name;
}

double load_average() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? load : 0;
}

} // namespace

Machine this_machine(const Backend& tested) {
    Machine machine;
    machine.cpu = cpu_name();
    machine.cores = std::thread::hardware_concurrency();
    machine.memory_bytes =
        static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGE_SIZE));
    machine.system = system_name();
    machine.compiler = compiler_name();
    machine.version = ANVIL_VERSION;
    machine.device = tested.device_name();
    machine.driver = tested.driver_name();
    machine.float_loop = make_float_cpu_backend()->driver_name();
    machine.load = load_average();
    return machine;
}

} // namespace anvil
