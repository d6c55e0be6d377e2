// Rows of unequal length in one array, some of them replaced.
#pragma once

#include "engine/core/types.h"

#include <algorithm>
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
/// new, and all of them are in `anew`. Moves what lies between the rows that change, no more.
/// @param begin_of: (row) -> uint32_t&, for rows 0 to row_count
template <typename Item, typename Begin>
void replace_rows(std::vector<Item>& items, const RowsAnew<Item>& anew, size_t former_count, size_t row_count,
                  const Begin& begin_of) {
    /// Items that stay together, from the end of a changed row to the next one.
    struct Block {
        size_t first_row, last_row, from, end, to;
    };
    const size_t former_size = items.size();
    const auto former_begin = [&](size_t row) -> size_t {
        return row < former_count ? begin_of(row) : former_size;
    };
    std::vector<Block> blocks;
    size_t row = 0, size = 0;
    for (size_t i = 0; i <= anew.rows.size(); ++i) {
        const size_t last = i < anew.rows.size() ? anew.rows[i] : row_count;
        blocks.push_back({row, last, former_begin(row), former_begin(last), size});
        size += blocks.back().end - blocks.back().from + (last < row_count ? anew.counts[i] : 0);
        row = last + 1;
    }
    items.resize(std::max(size, former_size));
    const auto at = [&](size_t place) { return items.begin() + static_cast<std::ptrdiff_t>(place); };
    // Places keep their order: those that move back never reach one that moves on, nor the other way.
    for (const Block& b : blocks) {
        if (b.to < b.from) {
            std::move(at(b.from), at(b.end), at(b.to));
        }
    }
    for (auto b = blocks.rbegin(); b != blocks.rend(); ++b) {
        if (b->to > b->from) {
            std::move_backward(at(b->from), at(b->end), at(b->to + b->end - b->from));
        }
    }
    items.resize(size);
    auto next_item = anew.items.begin();
    for (size_t i = 0; i < blocks.size(); ++i) {
        const Block& b = blocks[i];
        for (size_t r = b.first_row; r < b.last_row; ++r) {
            begin_of(r) += static_cast<uint32_t>(b.to - b.from);
        }
        const size_t after = b.to + b.end - b.from;
        if (b.last_row < row_count) {
            std::copy(next_item, next_item + anew.counts[i], at(after));
            next_item += anew.counts[i];
        }
        begin_of(b.last_row) = static_cast<uint32_t>(after);
    }
}

} // namespace anvil
