#include "engine/core/parallel_for.h"
#include "engine/occluder/brick_tree.h"

#include <cmath>

namespace anvil {

namespace {

void round_as_stored(Brick& brick) {
    float largest = 0;
    for (const glm::vec4& sample : brick.samples) {
        largest = std::max(largest, std::abs(sample.w));
    }
    while (largest > static_cast<float>(1 << brick.range)) {
        ++brick.range;
    }
    const double unit = brick.unit();
    for (glm::vec4& sample : brick.samples) {
        sample.w = static_cast<float>(nearest_whole(sample.w / unit) * unit);
    }
}

/// The places in a brick, along one axis, of samples that it shares with its neighbour in this direction.
struct Range {
    int begin;
    int end;
};

Range shared_places(int step) {
    return {step > 0 ? brick_cells : 0, step < 0 ? 1 : brick_side};
}

/// What a brick needs to take over values from its coarser neighbours.
class Stitcher {
  public:
    Stitcher(BrickTree& tree, const std::vector<uint32_t>& table) : tree_(tree), table_(table) {}

    void stitch(Brick& brick) {
        coarsest_.fill(nullptr);
        bool any = false;
        for (int i = 0; i < 27; ++i) {
            const CellIndex step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            if (const Brick* found = neighbour(brick, step)) {
                offer(*found, step);
                any = true;
            }
        }
        for (int i = 0; any && i < brick_samples; ++i) {
            if (coarsest_[i] != nullptr) {
                const CellIndex cells = brick.origin() + (sample_place(i) << brick.level);
                brick.samples[i] = coarsest_[i]->interpolated(Vec3(cells));
            }
        }
        round_as_stored(brick);
    }

  private:
    /// A neighbour that is coarser, else nullptr. One place tells, since coarser bricks cover whole blocks.
    const Brick* neighbour(const Brick& brick, const CellIndex& step) const {
        const CellIndex place = (brick.place + step) << brick.level;
        const glm::ivec3& grid = tree_.layout.grid;
        if (glm::any(glm::lessThan(place, CellIndex(0))) || glm::any(glm::greaterThanEqual(place, grid))) {
            return nullptr;
        }
        const Brick& found = tree_.bricks[table_[place.x + grid.x * (place.y + grid.y * place.z)]];
        return found.level > brick.level ? &found : nullptr;
    }

    void offer(const Brick& neighbour, const CellIndex& step) {
        const Range xs = shared_places(step.x);
        const Range ys = shared_places(step.y);
        const Range zs = shared_places(step.z);
        for (int z = zs.begin; z < zs.end; ++z) {
            for (int y = ys.begin; y < ys.end; ++y) {
                for (int x = xs.begin; x < xs.end; ++x) {
                    const Brick*& coarsest = coarsest_[sample_index({x, y, z})];
                    if (coarsest == nullptr || neighbour.level > coarsest->level) {
                        coarsest = &neighbour;
                    }
                }
            }
        }
    }

    BrickTree& tree_;
    const std::vector<uint32_t>& table_;
    std::array<const Brick*, brick_samples> coarsest_{}; ///< of the neighbours that have a sample too
};

} // namespace

void stitch_levels(BrickTree& tree, const std::vector<uint32_t>& table) {
    size_t begin = 0;
    while (begin < tree.bricks.size()) { // coarse levels first: what is taken over is final
        size_t end = begin;
        while (end < tree.bricks.size() && tree.bricks[end].level == tree.bricks[begin].level) {
            ++end;
        }
        parallel_for(end - begin, 64, [&](size_t from, size_t to) {
            Stitcher stitcher(tree, table);
            for (size_t i = begin + from; i < begin + to; ++i) {
                stitcher.stitch(tree.bricks[i]);
            }
        });
        begin = end;
    }
}

} // namespace anvil
