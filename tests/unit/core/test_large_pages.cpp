#include "engine/core/large_pages.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>

using namespace anvil;

TEST_CASE("vectors filled in large pages are like others, of any size and again") {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}, size_t{2000000}}) {
        std::vector<uint32_t> items;
        fill_large(items, count, count + count / 8);
        REQUIRE(items.size() == count);
        CHECK(items.capacity() >= count + count / 8);
        CHECK(std::all_of(items.begin(), items.end(), [](uint32_t item) { return item == 0; }));
        std::fill(items.begin(), items.end(), 7U);
        fill_large(items, count + 5);
        CHECK(std::count(items.begin(), items.end(), 7U) == static_cast<std::ptrdiff_t>(count));
        CHECK(items.size() == count + 5);
    }
}

TEST_CASE("a range within one page, or none, is left as it is") {
    std::vector<char> bytes(100, 'a');
    use_large_pages(bytes.data(), bytes.size());
    use_large_pages(bytes.data() + 50, 0);
    CHECK(std::count(bytes.begin(), bytes.end(), 'a') == 100);
}
