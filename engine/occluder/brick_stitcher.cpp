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
        sample.w = static_cast<float>(std::round(sample.w / unit) * unit);
    }
}

/// What a brick needs to take over values from its coarser neighbours.
class Stitcher {
  public:
    Stitcher(BrickTree& tree, const std::vector<uint32_t>& table) : tree_(tree), table_(table) {}

    void stitch(Brick& brick) {
        for (int i = 0; i < 27; ++i) {
            neighbours_[i] = neighbour(brick, CellIndex(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
        }
        for (int i = 0; i < brick_samples; ++i) {
            stitch_sample(brick, sample_place(i));
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

    void stitch_sample(Brick& brick, const CellIndex& s) {
        const Brick* coarsest = nullptr;
        for (int i = 0; i < 27; ++i) {
            const CellIndex step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            if (neighbours_[i] != nullptr && touches(s, step) &&
                (coarsest == nullptr || neighbours_[i]->level > coarsest->level)) {
                coarsest = neighbours_[i];
            }
        }
        if (coarsest != nullptr) {
            brick.samples[sample_index(s)] =
                coarsest->interpolated(Vec3(brick.origin() + (s << brick.level)));
        }
    }

    static bool touches(const CellIndex& s, const CellIndex& step) {
        for (int i = 0; i < 3; ++i) {
            if ((step[i] < 0 && s[i] != 0) || (step[i] > 0 && s[i] != brick_cells)) {
                return false;
            }
        }
        return true;
    }

    BrickTree& tree_;
    const std::vector<uint32_t>& table_;
    std::array<const Brick*, 27> neighbours_{};
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
