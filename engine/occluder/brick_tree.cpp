#include "engine/occluder/brick_tree.h"

#include <algorithm>

namespace anvil {

std::vector<uint32_t> brick_table(const BrickTree& tree) {
    const glm::ivec3& grid = tree.layout.grid;
    std::vector<uint32_t> table(size_t(grid.x) * grid.y * grid.z);
    for (size_t b = 0; b < tree.bricks.size(); ++b) { // finer ones overwrite, they come later
        const Brick& brick = tree.bricks[b];
        const int width = 1 << brick.level;
        const CellIndex low = brick.place * width;
        for (int z = low.z; z < low.z + width; ++z) {
            for (int y = low.y; y < low.y + width; ++y) {
                const auto row = table.begin() + (low.x + grid.x * (y + std::ptrdiff_t(grid.y) * z));
                std::fill(row, row + width, static_cast<uint32_t>(b));
            }
        }
    }
    return table;
}

} // namespace anvil
