#include "engine/mesh/contour_grid.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"

namespace anvil::contour {

namespace {

int local(const Index3& i, int side) {
    return i.x + side * (i.y + side * i.z);
}

Index3 corner_offset(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

/// Calls body(index) for all x, y, z in [low, high), x fastest.
template <class Body>
void for_each_index(const Index3& low, const Index3& high, const Body& body) {
    for (int z = low.z; z < high.z; ++z) {
        for (int y = low.y; y < high.y; ++y) {
            for (int x = low.x; x < high.x; ++x) {
                body(Index3(x, y, z));
            }
        }
    }
}

void check(const Box& box, int cells) {
    const Vec3 extent = box.high - box.low;
    if (!is_finite(extent) || !(std::min({extent.x, extent.y, extent.z}) > 0)) {
        throw InputError("cannot polygonize in a box that is empty, flat or not finite");
    }
    if (cells < 1 || cells > 2048) {
        throw InputError("cannot polygonize with " + std::to_string(cells) +
                         " cells along the longest side; give 1 to 2048");
    }
}

} // namespace

Grid::Grid(const ScalarField& f, const Box& box, const PolygonizeOptions& options) : f_(f) {
    check(box, options.cells);
    const Vec3 extent = box.high - box.low;
    size_ = std::max({extent.x, extent.y, extent.z}) / options.cells;
    cell_counts_ = Index3(glm::ceil(extent / size_ - 1e-9)) + 3;
    // Off the box's own planes and centre, where solids like to have their faces: a face through grid points
    // would put vertices on the walls of their cells.
    const Vec3 shift(0.0371, 0.0913, 0.1357);
    origin_ = box.centre() - size_ * (0.5 * Vec3(cell_counts_) + shift);
    block_counts_ = (cell_counts_ + (block_cells - 1)) / block_cells;
    const size_t all = static_cast<size_t>(block_counts_.x) * static_cast<size_t>(block_counts_.y) *
                       static_cast<size_t>(block_counts_.z);
    block_number_.assign(all, no_index);
    visited_.assign(all, 0);
    std::vector<Index3> wanted = candidate_blocks(options.lipschitz);
    while (!wanted.empty()) {
        add_blocks(wanted);
        wanted = missing_neighbours();
    }
    list_cells();
}

size_t Grid::slot_of(const Index3& block) const {
    return static_cast<size_t>(block.x) +
           static_cast<size_t>(block_counts_.x) *
               (static_cast<size_t>(block.y) +
                static_cast<size_t>(block_counts_.y) * static_cast<size_t>(block.z));
}

/// Without the bound: all blocks. With it: an octree's descent from large blocks to those of block_cells.
std::vector<Index3> Grid::candidate_blocks(bool lipschitz) const {
    int side = lipschitz ? 8 : 1;
    std::vector<Index3> blocks;
    for_each_index(Index3(0), (block_counts_ + (side - 1)) / side,
                   [&](const Index3& i) { blocks.push_back(i); });
    while (lipschitz) {
        keep_near(blocks, side * block_cells);
        if (side == 1) {
            break;
        }
        side /= 2;
        std::vector<Index3> children;
        for (const Index3& parent : blocks) {
            for_each_index(2 * parent, 2 * parent + 2, [&](const Index3& i) {
                if (glm::all(glm::lessThan(i * side, block_counts_))) {
                    children.push_back(i);
                }
            });
        }
        blocks = std::move(children);
    }
    return blocks;
}

void Grid::keep_near(std::vector<Index3>& blocks, int cells_each) const {
    const double reach = 0.5 * std::sqrt(3.0) * (cells_each * size_) * (1 + 1e-9);
    std::vector<char> near(blocks.size());
    parallel_for(blocks.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3 centre = origin_ + size_ * cells_each * (Vec3(blocks[i]) + 0.5);
            near[i] = !(std::abs(f_(centre)) > reach);
        }
    });
    size_t kept = 0;
    for (size_t i = 0; i < blocks.size(); ++i) {
        if (near[i]) {
            blocks[kept++] = blocks[i];
        }
    }
    blocks.resize(kept);
}

void Grid::sample_block(Block& block) const {
    block.samples.resize(block_nodes * block_nodes * block_nodes);
    size_t inside = 0;
    const Index3 first = block.index * block_cells;
    for_each_index(Index3(0), Index3(block_nodes), [&](const Index3& i) {
        const Index3 node = first + i;
        const bool rim = glm::any(glm::lessThanEqual(node, Index3(0))) ||
                         glm::any(glm::greaterThanEqual(node, cell_counts_));
        const double value = rim ? 0 : f_(point(node));
        // Not a number is outside, as the rim is; 0 there puts the crossing at the grid point.
        block.samples[static_cast<size_t>(local(i, block_nodes))] = value == value ? value : 0;
        inside += value < 0;
    });
    if (inside == 0 || inside == block.samples.size()) {
        block.samples = {};
    }
}

void Grid::add_blocks(const std::vector<Index3>& wanted) {
    std::vector<Block> sampled(wanted.size());
    parallel_for(wanted.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            sampled[i].index = wanted[i];
            sample_block(sampled[i]);
        }
    });
    for (Block& block : sampled) {
        const size_t slot = slot_of(block.index);
        visited_[slot] = 1;
        if (!block.samples.empty()) {
            block_number_[slot] = static_cast<uint32_t>(blocks_.size());
            blocks_.push_back(std::move(block));
        }
    }
}

/// Blocks that were skipped although the surface enters them from a neighbour: none if the field keeps its
/// bound.
std::vector<Index3> Grid::missing_neighbours() const {
    std::vector<Index3> missing;
    std::vector<char> listed(visited_);
    for (const Block& block : blocks_) {
        for (int face = 0; face < 6; ++face) {
            Index3 neighbour = block.index;
            neighbour[face / 2] += face & 1 ? 1 : -1;
            if (glm::any(glm::lessThan(neighbour, Index3(0))) ||
                glm::any(glm::greaterThanEqual(neighbour, block_counts_)) || listed[slot_of(neighbour)]) {
                continue;
            }
            Index3 low(0);
            Index3 high(block_nodes);
            low[face / 2] = face & 1 ? block_nodes - 1 : 0;
            high[face / 2] = low[face / 2] + 1;
            int inside = 0;
            int all = 0;
            for_each_index(low, high, [&](const Index3& i) {
                inside += block.samples[static_cast<size_t>(local(i, block_nodes))] < 0;
                ++all;
            });
            if (inside != 0 && inside != all) {
                listed[slot_of(neighbour)] = 1;
                missing.push_back(neighbour);
            }
        }
    }
    return missing;
}

void Grid::list_cells() {
    for (Block& block : blocks_) {
        block.cell_number.assign(block_cells * block_cells * block_cells, no_index);
        for_each_index(Index3(0), Index3(block_cells), [&](const Index3& i) {
            uint8_t inside = 0;
            for (int c = 0; c < 8; ++c) {
                const double value =
                    block.samples[static_cast<size_t>(local(i + corner_offset(c), block_nodes))];
                inside |= static_cast<uint8_t>((value < 0) << c);
            }
            if (inside != 0 && inside != 0xff) {
                block.cell_number[static_cast<size_t>(local(i, block_cells))] =
                    static_cast<uint32_t>(cells_.size());
                cells_.push_back({block.index * block_cells + i, inside});
            }
        });
    }
}

uint32_t Grid::cell_at(const Index3& index) const {
    const Index3 block = index / block_cells;
    return blocks_[block_number_[slot_of(block)]]
        .cell_number[static_cast<size_t>(local(index - block * block_cells, block_cells))];
}

double Grid::sample(const Index3& cell, int corner) const {
    const Index3 block = cell / block_cells;
    const Index3 node = cell - block * block_cells + corner_offset(corner);
    return blocks_[block_number_[slot_of(block)]].samples[static_cast<size_t>(local(node, block_nodes))];
}

} // namespace anvil::contour
