#include "engine/core/parallel_for.h"
#include "engine/occluder/brick_sampler.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t clusters_at_once = 64;    // a thread's worth, between two reports of progress
constexpr size_t clusters_on_device = 256; // some 200,000 points a round

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
    BrickGrower(const ExactDistance& solid, BrickTree& tree, Progress& progress, SearchDevice* device)
        : solid_(solid), tree_(tree), progress_(progress), wanted_(wanted_roots(tree.layout)),
          on_device_(device != nullptr ? solid.tracer_with(*device) : nullptr) {}

    void grow(int level) {
        if (level < tree_.layout.top_level) {
            wanted_ = wanted_children(tree_.bricks, first_);
        }
        first_ = tree_.bricks.size();
        tree_.bricks.resize(first_ + wanted_.size());
        errors_.assign(wanted_.size(), 0.0);
        parents_.clear();
        for (size_t i = 0; i < wanted_.size(); ++i) {
            tree_.bricks[first_ + i].place = wanted_[i].place;
            tree_.bricks[first_ + i].level = level;
            if (level < tree_.layout.top_level) {
                parents_.push_back(&tree_.bricks[wanted_[i].parent]);
            }
        }
        const std::vector<size_t> clusters = cluster_begins();
        const size_t count = clusters.size() - 1;
        const size_t at_once = on_device_ ? clusters_on_device : clusters_at_once;
        for (size_t begin = 0; begin < count; begin += at_once) {
            // Each level takes about four times as long as the one before.
            const double part = static_cast<double>(begin) / static_cast<double>(count);
            progress_.report("bake", std::pow(0.25, level) * (0.25 + 0.75 * part));
            const size_t end = std::min(begin + at_once, count);
            const std::span<const size_t> some(&clusters[begin], end - begin + 1);
            if (on_device_) {
                sample_together(some);
            } else {
                sample_apart(some);
            }
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

    /// A cluster is that between two of `clusters`.
    void begin_cluster(BrickSampler& sampler, std::span<const size_t> clusters, size_t i) {
        const size_t begin = clusters[i];
        const size_t count = clusters[i + 1] - begin;
        const std::span<Brick> children(&tree_.bricks[first_ + begin], count);
        const auto parents = std::span(parents_).subspan(parents_.empty() ? 0 : begin);
        const bool finest = children.front().level == 0;
        sampler.begin({children, parents.first(parents_.empty() ? 0 : count)},
                      finest ? std::span(errors_).subspan(begin, count) : std::span<double>());
    }

    /// Each cluster by itself, on all cores.
    void sample_apart(std::span<const size_t> clusters) {
        parallel_for(clusters.size() - 1, 1, [&](size_t begin, size_t end) {
            BrickSampler sampler(tree_.layout);
            const std::unique_ptr<DistanceTracer> tracer = solid_.tracer();
            for (size_t i = begin; i < end; ++i) {
                begin_cluster(sampler, clusters, i);
                do {
                    tracer->trace(sampler.points(), sampler.found());
                } while (sampler.advance());
            }
        });
    }

    /// All clusters round by round, so that the device gets the points of all at once.
    void sample_together(std::span<const size_t> clusters) {
        while (samplers_.size() + 1 < clusters.size()) {
            samplers_.emplace_back(tree_.layout);
        }
        parallel_for(clusters.size() - 1, 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                begin_cluster(samplers_[i], clusters, i);
            }
        });
        std::vector<BrickSampler*> open;
        for (size_t i = 0; i + 1 < clusters.size(); ++i) {
            open.push_back(&samplers_[i]);
        }
        while (!open.empty()) {
            advance_together(open);
        }
    }

    /// One round; keeps those that are not done.
    void advance_together(std::vector<BrickSampler*>& open) {
        std::vector<size_t> begins;
        points_.clear();
        for (const BrickSampler* sampler : open) {
            begins.push_back(points_.size());
            points_.insert(points_.end(), sampler->points().begin(), sampler->points().end());
        }
        found_.resize(points_.size());
        on_device_->trace(points_, found_);
        parallel_for(open.size(), 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const std::span<SignedDistance> found = open[i]->found();
                std::copy_n(found_.begin() + static_cast<std::ptrdiff_t>(begins[i]), found.size(),
                            found.begin());
                open[i] = open[i]->advance() ? open[i] : nullptr;
            }
        });
        std::erase(open, nullptr);
    }

    const ExactDistance& solid_;
    BrickTree& tree_;
    Progress& progress_;
    std::vector<Wanted> wanted_;
    std::unique_ptr<DistanceTracer> on_device_; ///< none: without a device
    size_t first_ = 0;                          ///< brick of the level at work
    std::vector<const Brick*> parents_;         ///< of its bricks; none of roots
    std::vector<double> errors_;                ///< of its bricks; -1: not needed
    std::vector<BrickSampler> samplers_;        ///< on a device: of the clusters at work
    std::vector<Vec3> points_;                  ///< theirs
    std::vector<SignedDistance> found_;
};

} // namespace

BrickTree grow_bricks(const ExactDistance& solid, const BrickLayout& layout, Progress& progress,
                      SearchDevice* device) {
    BrickTree tree;
    tree.layout = layout;
    BrickGrower grower(solid, tree, progress, device);
    for (int level = layout.top_level; level >= 0; --level) {
        grower.grow(level);
    }
    grower.finish();
    return tree;
}

} // namespace anvil
