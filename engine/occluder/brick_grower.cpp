#include "engine/core/parallel_for.h"
#include "engine/occluder/brick_sampler.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t clusters_at_once = 64;

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
        const std::vector<size_t> clusters = cluster_begins();
        const size_t count = clusters.size() - 1;
        for (size_t begin = 0; begin < count; begin += clusters_at_once) {
            // Each level takes about four times as long as the one before.
            const double part = static_cast<double>(begin) / static_cast<double>(count);
            progress_.report("bake", std::pow(0.25, level) * (0.25 + 0.75 * part));
            parallel_for(std::min(clusters_at_once, count - begin), 1, [&](size_t from, size_t to) {
                BrickSampler sampler(solid_, tree_.layout);
                for (size_t i = begin + from; i < begin + to; ++i) {
                    sample_cluster(sampler, clusters[i], clusters[i + 1]);
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
    /// Where in wanted_ each cluster begins, and the end; roots are alone.
    std::vector<size_t> cluster_begins() const {
        std::vector<size_t> begins;
        for (size_t i = 0; i < wanted_.size(); ++i) {
            if (first_ == 0 || i == 0 ||
                !share_cluster(tree_.bricks[wanted_[i].parent], tree_.bricks[wanted_[i - 1].parent])) {
                begins.push_back(i);
            }
        }
        begins.push_back(wanted_.size());
        return begins;
    }

    void sample_cluster(BrickSampler& sampler, size_t begin, size_t end) {
        const std::span<Brick> children(&tree_.bricks[first_ + begin], end - begin);
        const std::span<double> errors(&errors_[begin], children.size());
        const bool finest = children.front().level == 0;
        std::vector<const Brick*> parents;
        for (size_t i = begin; i < end; ++i) {
            parents.push_back(&tree_.bricks[wanted_[i].parent]);
        }
        if (first_ == 0) {
            sampler.sample_root(children.front());
        } else if (finest) {
            sampler.sample_finest_children({children, parents}, errors);
        } else {
            sampler.sample_children({children, parents});
        }
        if (!finest) {
            sampler.find_octants_to_refine(children);
            return;
        }
        sampler.find_surface_errors(children, errors);
    }

    const ExactDistance& solid_;
    BrickTree& tree_;
    Progress& progress_;
    std::vector<Wanted> wanted_;
    size_t first_ = 0;           ///< brick of the level at work
    std::vector<double> errors_; ///< of its bricks; -1: not needed
};

} // namespace

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

} // namespace anvil
