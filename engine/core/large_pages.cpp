#include "engine/core/large_pages.h"

#include <cstdint>
#include <sys/mman.h>

namespace anvil {

void use_large_pages(void* begin, size_t bytes) {
    constexpr uintptr_t large_page = uintptr_t{1} << 21;
    const auto first = reinterpret_cast<uintptr_t>(begin);
    const uintptr_t from = (first + large_page - 1) / large_page * large_page;
    const uintptr_t to = (first + bytes) / large_page * large_page;
    // It is a wish: memory stays as good as it was if this fails.
    if (from < to) {
        ::madvise(static_cast<char*>(begin) + (from - first), to - from, MADV_HUGEPAGE);
    }
}

} // namespace anvil
