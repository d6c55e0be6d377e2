// Fills bricks with samples and finds where they are too coarse; internal to engine/occluder.
#pragma once

#include "engine/occluder/brick_tree.h"

#include <span>
#include <vector>

namespace anvil {

/// Bricks of one level that are sampled together, of up to eight neighbouring parents: they have samples in
/// common with each other and with the parents. `parents` has one entry for each child.
struct Cluster {
    std::span<Brick> children;
    std::span<const Brick* const> parents;
};

/// Whether two bricks' children belong to one cluster.
bool share_cluster(const Brick& parent, const Brick& other);

/// Samples a cluster after the other, in rounds: what it wants to know is asked for at once, since many
/// points together are what makes distances cheap.
///
///     for (bool more = sampler.begin(...); more; more = sampler.advance()) {
///         tracer.trace(sampler.points(), sampler.found());
///     }
class BrickSampler {
  public:
    explicit BrickSampler(const BrickLayout& layout) : layout_(layout) {}

    /// A cluster, which outlives its rounds; without parents: one root. On levels above the finest,
    /// where `errors` is empty, `refined` of the children is set in the end: the octants that the surface is
    /// near to, or that they interpolate too badly. On the finest level `errors` is what they may be off
    /// most, at some of their cells' centres near the surface, in voxels; -1 for those that their parents
    /// spare: they are held against the samples in the middle of the parents' cells first, and most that are
    /// spared cost no more than these.
    void begin(const Cluster& cluster, std::span<double> errors);
    /// After points() were found. @return false: the cluster is done.
    bool advance();

    std::span<const Vec3> points() const { return points_; }
    std::span<SignedDistance> found() { return found_; }

  private:
    struct Test {
        size_t brick;
        CellIndex cell;
    };
    enum class Round { centres, samples, tests };

    /// Whether the coarser brick interpolates well enough at all of the other's samples.
    bool spares(const Brick& coarser, const Brick& brick) const;
    /// Whether an interpolated sample is near enough to the true one where the error may be so much larger
    /// beside it.
    bool is_good(const glm::dvec4& interpolated, const glm::dvec4& truth, double beside) const;
    double normal_tolerance(double distance) const;
    bool spares_centres(const Brick& parent, const Brick& child) const;
    bool is_spared(size_t child) const { return !errors_.empty() && errors_[child] < 0; }
    void share_samples();
    void ask_centres();
    void ask_samples();
    void ask(std::span<const int> places);
    void take_samples();
    void spare_by_centres();
    void spare_by_samples();
    void ask_octants();
    void take_octants();
    void ask_surface_errors();
    void take_surface_errors();
    Vec3 point(const Brick& brick, const Vec3& within) const;
    Vec3 lattice_cells(int at) const;
    glm::vec4 found_sample(size_t i) const;
    /// visit(index in the lattice, sample) for each sample of a child.
    template <class AnyBrick, class Visit>
    void for_samples(AnyBrick& child, const Visit& visit) const;
    /// visit(index in the lattice) for each of the child's samples in the middle of a parent's cell.
    template <class Visit>
    void for_centres(const Brick& child, const Visit& visit) const;
    template <class Wanted>
    void ask_cells(const Wanted& wanted);
    glm::dvec4 interpolated(size_t i) const;

    const BrickLayout& layout_;
    Cluster cluster_;
    std::span<double> errors_;
    Round round_ = Round::centres;
    CellIndex low_{0}; ///< of the lattice, in bricks of the children's level
    int level_ = 0;    ///< of the children
    std::vector<Test> tests_;
    std::vector<glm::vec4> lattice_; ///< samples of a cluster
    std::vector<bool> known_;        ///< which of them, asked for included
    std::vector<int> asked_;         ///< places in the lattice of points_
    std::vector<Vec3> points_;
    std::vector<SignedDistance> found_;
};

} // namespace anvil
