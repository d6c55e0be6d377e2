#include "engine/occluder/brick_tree.h"

#include "engine/core/parallel_for.h"
#include "engine/occluder/adaptive_field.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

// Voxels around the surface where the finest level is tried before a coarser one is found good enough, so
// that nothing as small as a voxel slips through between the samples of coarse levels.
constexpr double surface_reach = 2;
constexpr size_t families_at_once = 128;

int sample_index(int x, int y, int z) {
    return x + brick_side * (y + brick_side * z);
}

/// All places of a side^3 lattice, each beside the one before.
std::vector<CellIndex> winding_path(int side) {
    std::vector<CellIndex> path;
    for (int z = 0; z < side; ++z) {
        for (int j = 0; j < side; ++j) {
            const int y = z % 2 == 0 ? j : side - 1 - j;
            for (int i = 0; i < side; ++i) {
                path.emplace_back((y + z) % 2 == 0 ? i : side - 1 - i, y, z);
            }
        }
    }
    return path;
}

int octant_of(const CellIndex& cell) {
    constexpr int half = brick_cells / 2;
    return (cell.x >= half ? 1 : 0) + (cell.y >= half ? 2 : 0) + (cell.z >= half ? 4 : 0);
}

/// Samples one brick after the other; one object a thread.
class BrickSampler {
  public:
    BrickSampler(const ExactDistance& solid, const BrickLayout& layout)
        : solid_(solid), layout_(layout), corners_(winding_path(brick_side)),
          cells_(winding_path(brick_cells)), family_(winding_path(family_side)) {}

    void sample(Brick& brick) {
        points_.clear();
        for (const CellIndex& corner : corners_) {
            points_.push_back(point(brick, Vec3(corner)));
        }
        trace();
        for (size_t i = 0; i < corners_.size(); ++i) {
            const CellIndex& c = corners_[i];
            brick.samples[sample_index(c.x, c.y, c.z)] = found_sample(i);
        }
    }

    /// Bricks that refine octants of one parent, together: they have samples in common, with each other and
    /// with the parent.
    void sample_children(const Brick& parent, std::span<Brick> children) {
        lattice_.resize(family_side * family_side * family_side);
        open_.assign(lattice_.size(), false);
        for (const Brick& child : children) {
            for_samples(parent, child, [&](int at, glm::vec4) { open_[at] = true; });
        }
        for (int i = 0; i < brick_samples; ++i) {
            const int at = family_index(2 * (i % brick_side), 2 * (i / brick_side % brick_side),
                                        2 * (i / (brick_side * brick_side)));
            lattice_[at] = parent.samples[i];
            open_[at] = false;
        }
        points_.clear();
        tested_.clear();
        for (const CellIndex& c : family_) {
            if (open_[family_index(c.x, c.y, c.z)]) {
                tested_.push_back(c);
                points_.push_back(point(parent, 0.5 * Vec3(c)));
            }
        }
        trace();
        for (size_t i = 0; i < tested_.size(); ++i) {
            lattice_[family_index(tested_[i].x, tested_[i].y, tested_[i].z)] = found_sample(i);
        }
        for (Brick& child : children) {
            for_samples(parent, child, [&](int at, glm::vec4& sample) { sample = lattice_[at]; });
        }
    }

    /// Octants that the surface is near to, or that the brick interpolates too badly.
    uint8_t octants_to_refine(const Brick& brick) {
        const uint8_t near = octants_near_surface(brick);
        test_cells(brick, [&](const CellIndex& cell) { return (near >> octant_of(cell) & 1) == 0; });
        uint8_t bad = near;
        for (size_t i = 0; i < tested_.size(); ++i) {
            const double distance = found_[i].distance / layout_.voxel;
            if (error(brick, i) > adaptive_tolerance(distance)) {
                bad |= static_cast<uint8_t>(1 << octant_of(tested_[i]));
            }
        }
        return bad;
    }

    /// Whether the coarser brick interpolates well enough at all of this one's samples.
    static bool spared_by(const Brick& coarser, const Brick& brick) {
        for (int i = 0; i < brick_samples; ++i) {
            const CellIndex s(i % brick_side, i / brick_side % brick_side, i / (brick_side * brick_side));
            const double distance = brick.samples[i].w;
            const double other = coarser.interpolated(Vec3(brick.origin() + (s << brick.level))).w;
            if (std::abs(other - distance) > adaptive_tolerance(distance)) {
                return false;
            }
        }
        return true;
    }

    /// Largest interpolation error at some of the cells' centres near the surface, in voxels.
    double surface_error(const Brick& brick) {
        const CellIndex& p = brick.place;
        const int phase = (p.x + 2 * p.y + 4 * p.z) & 7; // all cells take their turn from brick to brick
        test_cells(brick, [&](const CellIndex& cell) {
            const int turn = (cell.x & 1) + 2 * (cell.y & 1) + 4 * (cell.z & 1);
            return turn == phase &&
                   std::abs(brick.samples[sample_index(cell.x, cell.y, cell.z)].w) < surface_reach;
        });
        double worst = 0;
        for (size_t i = 0; i < tested_.size(); ++i) {
            worst = std::max(worst, error(brick, i));
        }
        return worst;
    }

  private:
    Vec3 cells_at(const Brick& brick, const Vec3& within) const {
        return Vec3(brick.origin()) + static_cast<double>(1 << brick.level) * within;
    }
    Vec3 point(const Brick& brick, const Vec3& within) const {
        return layout_.point(cells_at(brick, within));
    }

    glm::vec4 found_sample(size_t i) const {
        return {glm::vec3(found_[i].normal), static_cast<float>(found_[i].distance / layout_.voxel)};
    }

    /// All of a parent's octants' samples are a lattice of this side.
    static constexpr int family_side = 2 * brick_cells + 1;
    static int family_index(int x, int y, int z) { return x + family_side * (y + family_side * z); }

    /// visit(index in the family's lattice, sample) for each sample of a child.
    template <class AnyBrick, class Visit>
    static void for_samples(const Brick& parent, AnyBrick& child, const Visit& visit) {
        const CellIndex low = (child.place - parent.place * 2) * brick_cells;
        for (int i = 0; i < brick_samples; ++i) {
            const int at = family_index(low.x + i % brick_side, low.y + i / brick_side % brick_side,
                                        low.z + i / (brick_side * brick_side));
            visit(at, child.samples[i]);
        }
    }

    void trace() {
        found_.resize(points_.size());
        solid_.trace(points_, found_);
    }

    template <class Wanted>
    void test_cells(const Brick& brick, const Wanted& wanted) {
        points_.clear();
        tested_.clear();
        for (const CellIndex& cell : cells_) {
            if (wanted(cell)) {
                tested_.push_back(cell);
                points_.push_back(point(brick, Vec3(cell) + Vec3(0.5)));
            }
        }
        trace();
    }

    double error(const Brick& brick, size_t i) const {
        const double interpolated = brick.interpolated(cells_at(brick, Vec3(tested_[i]) + Vec3(0.5))).w;
        return std::abs(interpolated - found_[i].distance / layout_.voxel);
    }

    /// A point within reach of the surface has a sample, within half a cell's diagonal, that shows it.
    static uint8_t octants_near_surface(const Brick& brick) {
        const double reach = surface_reach + 0.5 * std::sqrt(3.0) * (1 << brick.level);
        constexpr int half = brick_cells / 2;
        uint8_t near = 0;
        for (int octant = 0; octant < 8; ++octant) {
            const CellIndex low(octant & 1 ? half : 0, octant & 2 ? half : 0, octant & 4 ? half : 0);
            for (int i = 0; i < 27; ++i) {
                const CellIndex s = low + CellIndex(i % 3, i / 3 % 3, i / 9);
                if (std::abs(brick.samples[sample_index(s.x, s.y, s.z)].w) <= reach) {
                    near |= static_cast<uint8_t>(1 << octant);
                }
            }
        }
        return near;
    }

    const ExactDistance& solid_;
    const BrickLayout& layout_;
    std::vector<CellIndex> corners_;
    std::vector<CellIndex> cells_;
    std::vector<CellIndex> family_;
    std::vector<glm::vec4> lattice_;
    std::vector<bool> open_;
    std::vector<CellIndex> tested_;
    std::vector<Vec3> points_;
    std::vector<SignedDistance> found_;
};

/// Where a brick is wanted, and whose octant that is.
struct Wanted {
    CellIndex place{0};
    size_t parent = 0;
    int octant = 0;
};

std::vector<Wanted> wanted_roots(const BrickLayout& layout) {
    const CellIndex count = layout.grid >> layout.top_level;
    const int bricks = count.x * count.y * count.z;
    std::vector<Wanted> wanted;
    wanted.reserve(static_cast<size_t>(bricks));
    for (int i = 0; i < bricks; ++i) {
        wanted.push_back({{i % count.x, i / count.x % count.y, i / (count.x * count.y)}});
    }
    return wanted;
}

std::vector<Wanted> wanted_children(const std::vector<Brick>& bricks, size_t first) {
    std::vector<Wanted> wanted;
    for (size_t parent = first; parent < bricks.size(); ++parent) {
        for (int octant = 0; octant < 8; ++octant) {
            if ((bricks[parent].refined >> octant & 1) != 0) {
                const CellIndex corner(octant & 1, octant >> 1 & 1, octant >> 2);
                wanted.push_back({bricks[parent].place * 2 + corner, parent, octant});
            }
        }
    }
    return wanted;
}

/// Takes out finest bricks that their parents spare, and bricks of which nothing is left.
void remove_needless(std::vector<Brick>& bricks, size_t first_finest, const std::vector<Wanted>& wanted,
                     const std::vector<bool>& spared) {
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (spared[i]) {
            bricks[wanted[i].parent].refined &= static_cast<uint8_t>(~(1 << wanted[i].octant));
            bricks[first_finest + i].refined = 0xff;
        }
    }
    std::erase_if(bricks, [](const Brick& brick) { return brick.refined == 0xff; });
}

/// Adds level after level to a tree.
class BrickGrower {
  public:
    BrickGrower(const ExactDistance& solid, BrickTree& tree, Progress& progress)
        : solid_(solid), tree_(tree), progress_(progress), wanted_(wanted_roots(tree.layout)) {}

    void grow(int level) {
        if (level < tree_.layout.top_level) {
            wanted_ = wanted_children(tree_.bricks, first_);
        }
        first_ = tree_.bricks.size();
        tree_.bricks.resize(first_ + wanted_.size());
        errors_.assign(wanted_.size(), 0.0);
        for (size_t i = 0; i < wanted_.size(); ++i) {
            tree_.bricks[first_ + i].place = wanted_[i].place;
            tree_.bricks[first_ + i].level = level;
        }
        const std::vector<size_t> families = family_begins();
        const size_t count = families.size() - 1;
        for (size_t begin = 0; begin < count; begin += families_at_once) {
            // Each level takes about four times as long as the one before.
            const double part = static_cast<double>(begin) / static_cast<double>(count);
            progress_.report("bake", std::pow(0.25, level) * (0.25 + 0.75 * part));
            parallel_for(std::min(families_at_once, count - begin), 1, [&](size_t from, size_t to) {
                BrickSampler sampler(solid_, tree_.layout);
                for (size_t i = begin + from; i < begin + to; ++i) {
                    sample_family(sampler, families[i], families[i + 1]);
                }
            });
        }
    }

    /// After the finest level.
    void finish() {
        std::vector<bool> spared;
        for (const double error : errors_) {
            spared.push_back(error < 0);
            tree_.error = std::max(tree_.error, error);
        }
        remove_needless(tree_.bricks, first_, wanted_, spared);
    }

  private:
    /// Where in wanted_ the children of each parent begin, and the end; roots are alone.
    std::vector<size_t> family_begins() const {
        std::vector<size_t> begins;
        for (size_t i = 0; i < wanted_.size(); ++i) {
            if (first_ == 0 || i == 0 || wanted_[i].parent != wanted_[i - 1].parent) {
                begins.push_back(i);
            }
        }
        begins.push_back(wanted_.size());
        return begins;
    }

    void sample_family(BrickSampler& sampler, size_t begin, size_t end) {
        const bool root = first_ == 0;
        const std::span<Brick> children(&tree_.bricks[first_ + begin], end - begin);
        const Brick& parent = tree_.bricks[root ? 0 : wanted_[begin].parent];
        if (root) {
            sampler.sample(children.front());
        } else {
            sampler.sample_children(parent, children);
        }
        for (size_t i = 0; i < children.size(); ++i) {
            Brick& child = children[i];
            if (child.level > 0) {
                child.refined = sampler.octants_to_refine(child);
            } else {
                const bool spared = !root && BrickSampler::spared_by(parent, child);
                errors_[begin + i] = spared ? -1 : sampler.surface_error(child);
            }
        }
    }

    const ExactDistance& solid_;
    BrickTree& tree_;
    Progress& progress_;
    std::vector<Wanted> wanted_;
    size_t first_ = 0;           ///< brick of the level at work
    std::vector<double> errors_; ///< of its bricks; -1: not needed
};

void round_as_stored(Brick& brick) {
    float largest = 0;
    for (const glm::vec4& sample : brick.samples) {
        largest = std::max(largest, std::abs(sample.w));
    }
    while (largest > static_cast<float>(1 << brick.range)) {
        ++brick.range;
    }
    const double unit = (1 << brick.range) / 32767.0;
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
        for (int z = 0; z < brick_side; ++z) {
            for (int y = 0; y < brick_side; ++y) {
                for (int x = 0; x < brick_side; ++x) {
                    stitch_sample(brick, {x, y, z});
                }
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
            brick.samples[sample_index(s.x, s.y, s.z)] =
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

glm::dvec4 Brick::interpolated(const Vec3& cells) const {
    const Vec3 within = (cells - Vec3(origin())) / static_cast<double>(1 << level);
    const Vec3 low = glm::clamp(glm::floor(within), Vec3(0), Vec3(brick_cells - 1));
    const Vec3 t = within - low;
    const int first = sample_index(static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z));
    glm::dvec4 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1;
        const int dy = corner >> 1 & 1;
        const int dz = corner >> 2;
        const double weight = (dx ? t.x : 1 - t.x) * (dy ? t.y : 1 - t.y) * (dz ? t.z : 1 - t.z);
        sum += weight * glm::dvec4(samples[first + sample_index(dx, dy, dz)]);
    }
    return sum;
}

BrickTree grow_bricks(const ExactDistance& solid, const BrickLayout& layout, Progress& progress) {
    BrickTree tree;
    tree.layout = layout;
    BrickGrower grower(solid, tree, progress);
    for (int level = layout.top_level; level >= 0; --level) {
        grower.grow(level);
    }
    grower.finish();
    return tree;
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
