#include "engine/gpu/pinned_libraries.h"

#ifdef __SANITIZE_ADDRESS__
#include <cstddef>
#include <dlfcn.h>
#include <link.h>
#include <string>
#include <vector>
#endif

namespace anvil {

#ifdef __SANITIZE_ADDRESS__

void pin_loaded_libraries() {
    std::vector<std::string> names; // opened after the walk, which holds the dynamic linker's lock
    const auto collect = [](dl_phdr_info* info, size_t /*size*/, void* list) {
        if (info->dlpi_name != nullptr && *info->dlpi_name != '\0') {
            static_cast<std::vector<std::string>*>(list)->emplace_back(info->dlpi_name);
        }
        return 0;
    };
    dl_iterate_phdr(collect, &names);
    for (const std::string& name : names) {
        dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    }
}

#else

void pin_loaded_libraries() {}

#endif

} // namespace anvil
