// Rows of unequal length in one array, some of them replaced.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// Rows to put in place of others: row rows[i] gets the next counts[i] of `items`.
template <typename Item>
struct RowsAnew {
    std::vector<uint32_t> rows; ///< ascending
    std::vector<uint32_t> counts;
    std::vector<Item> items;
};

/// `items` holds `row_count` rows, row r from begin_of(r) to begin_of(r + 1). Rows from `former_count` on are
/// new, and all of them are in `anew`. O(items), the most of it copying.
/// @param begin_of: (row) -> uint32_t&, for rows 0 to row_count
template <typename Item, typename Begin>
void replace_rows(std::vector<Item>& items, const RowsAnew<Item>& anew, size_t former_count, size_t row_count,
                  const Begin& begin_of) {
    std::vector<Item> result;
    result.reserve(items.size() + anew.items.size());
    const auto former_end = static_cast<uint32_t>(items.size());
    const auto former_begin = [&](size_t row) { return row < former_count ? begin_of(row) : former_end; };
    auto next_item = anew.items.begin();
    size_t row = 0;
    // Up to row `last` as before.
    const auto keep_until = [&](size_t last) {
        const uint32_t from = former_begin(row), to = former_begin(last);
        const auto shift = static_cast<uint32_t>(result.size()) - from;
        result.insert(result.end(), items.begin() + from, items.begin() + to);
        for (; row < last; ++row) {
            begin_of(row) += shift;
        }
    };
    for (size_t i = 0; i < anew.rows.size(); ++i) {
        keep_until(anew.rows[i]);
        // Where the next row was is still known: this one's place is written after that was read.
        const auto place = static_cast<uint32_t>(result.size());
        result.insert(result.end(), next_item, next_item + anew.counts[i]);
        next_item += anew.counts[i];
        begin_of(row) = place;
        ++row;
    }
    keep_until(row_count);
    begin_of(row_count) = static_cast<uint32_t>(result.size());
    items = std::move(result);
}

} // namespace anvil
