// Memory in large pages, where the system has them.
#pragma once

#include <cstddef>
#include <vector>

namespace anvil {

/// Asks for large pages in [begin, begin + bytes), which should not have been written to yet: tables of some
/// megabytes that are read here and there then cost fewer faults to fill and fewer misses to find. Does
/// nothing to what is smaller than a large page, nor where the system has none.
void use_large_pages(void* begin, size_t bytes);

/// As resize(), in such memory where it has to be taken; with room for `reserved`.
template <typename Item>
void fill_large(std::vector<Item>& items, size_t count, size_t reserved = 0) {
    items.reserve(reserved > count ? reserved : count);
    use_large_pages(items.data(), items.capacity() * sizeof(Item));
    items.resize(count);
}

} // namespace anvil
