#include "engine/occluder/brick_tree.h"

#include <algorithm>

namespace anvil {

glm::dvec4 Brick::interpolated(const Vec3& cells) const {
    const Vec3 within = (cells - Vec3(origin())) / static_cast<double>(1 << level);
    const Vec3 low = glm::clamp(glm::floor(within), Vec3(0), Vec3(brick_cells - 1));
    const Vec3 t = within - low;
    const int first = sample_index(CellIndex(low));
    glm::dvec4 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1;
        const int dy = corner >> 1 & 1;
        const int dz = corner >> 2;
        const double weight = (dx ? t.x : 1 - t.x) * (dy ? t.y : 1 - t.y) * (dz ? t.z : 1 - t.z);
        sum += weight * glm::dvec4(samples[first + sample_index({dx, dy, dz})]);
    }
    return sum;
}

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
