// Samples of a field on a grid, kept only in the blocks that the surface passes.
#pragma once

#include "engine/mesh/polygonize.h"

#include <vector>

namespace anvil::contour {

using Index3 = glm::ivec3;

/// A cell that the surface passes.
struct Cell {
    Index3 index;
    uint8_t inside = 0; ///< bit c: corner c is inside (f < 0)
};

/// A grid of cubic cells around a box, sampled block by block. The outermost grid points count as outside,
/// so that every surface is closed.
class Grid {
  public:
    Grid(const ScalarField& f, const Box& box, const PolygonizeOptions& options);

    double cell_size() const { return size_; }
    Vec3 point(const Index3& node) const { return origin_ + size_ * Vec3(node); }

    /// All cells with both inside and outside corners, in a fixed order.
    const std::vector<Cell>& cells() const { return cells_; }

    /// Number in cells() of the cell at `index`, which must be one of them.
    uint32_t cell_at(const Index3& index) const;

    /// Sample at corner `corner` of a cell of cells(); not negative where the grid ends.
    double sample(const Index3& cell, int corner) const;

  private:
    static constexpr int block_cells = 8;
    static constexpr int block_nodes = block_cells + 1;

    struct Block {
        Index3 index;
        std::vector<double> samples;       ///< block_nodes^3; empty if all lie on one side
        std::vector<uint32_t> cell_number; ///< block_cells^3
    };

    size_t slot_of(const Index3& block) const;
    std::vector<Index3> candidate_blocks(bool lipschitz) const;
    void keep_near(std::vector<Index3>& blocks, int cells_each) const;
    void sample_block(Block& block) const;
    void add_blocks(const std::vector<Index3>& wanted);
    std::vector<Index3> missing_neighbours() const;
    void list_cells();

    const ScalarField& f_;
    double size_ = 0;
    Vec3 origin_{0};
    Index3 cell_counts_{0};
    Index3 block_counts_{0};
    std::vector<Block> blocks_;
    std::vector<uint32_t> block_number_; ///< per block of the grid; no_index where none is kept
    std::vector<char> visited_;          ///< per block of the grid
    std::vector<Cell> cells_;
};

} // namespace anvil::contour
