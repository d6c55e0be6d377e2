// Fills bricks with samples and finds where they are too coarse; internal to engine/occluder.
#pragma once

#include "engine/occluder/brick_tree.h"

#include <memory>
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

/// Asks for the distances of many bricks at once, which is what makes them cheap. One object a thread.
class BrickSampler {
  public:
    BrickSampler(const ExactDistance& solid, const BrickLayout& layout)
        : tracer_(solid.tracer()), layout_(layout) {}

    /// A brick without a parent.
    void sample_root(Brick& brick);

    void sample_children(const Cluster& cluster);

    /// The same on the finest level: leaves out, with -1 in `errors`, those that their parents spare. They
    /// are held against the samples in the middle of the parents' cells first; most that are spared cost no
    /// more than these.
    void sample_finest_children(const Cluster& cluster, std::span<double> errors);

    /// Sets `refined` of the bricks sampled last: the octants that the surface is near to, or that they
    /// interpolate too badly.
    void find_octants_to_refine(std::span<Brick> bricks);

    /// Largest interpolation error of each of the bricks sampled last, at some of its cells' centres near the
    /// surface, in voxels. Negative entries of `errors` stay, and cost nothing.
    void find_surface_errors(std::span<const Brick> bricks, std::span<double> errors);

  private:
    struct Test {
        size_t brick;
        CellIndex cell;
    };

    /// Whether the coarser brick interpolates well enough at all of the other's samples.
    static bool spares(const Brick& coarser, const Brick& brick);
    bool spares_centres(const Brick& parent, const Brick& child) const;
    void begin(const Cluster& cluster);
    void sample_lattice(std::span<const int> places);
    void finish(const Cluster& cluster, std::span<const double> errors);
    Vec3 point(const Brick& brick, const Vec3& within) const;
    Vec3 lattice_cells(int at) const;
    glm::vec4 found_sample(size_t i) const;
    void trace();
    /// visit(index in the lattice, sample) for each sample of a child.
    template <class AnyBrick, class Visit>
    void for_samples(AnyBrick& child, const Visit& visit) const;
    /// visit(index in the lattice) for each of the child's samples in the middle of a parent's cell.
    template <class Visit>
    void for_centres(const Brick& child, const Visit& visit) const;
    template <class Wanted>
    void test_cells(std::span<const Brick> bricks, const Wanted& wanted);
    double error(std::span<const Brick> bricks, size_t i) const;

    std::unique_ptr<DistanceTracer> tracer_;
    const BrickLayout& layout_;
    CellIndex low_{0}; ///< of the lattice, in bricks of the children's level
    int level_ = 0;    ///< of the children
    std::vector<Test> tests_;
    std::vector<glm::vec4> lattice_; ///< samples of a cluster
    std::vector<bool> known_;        ///< which of them
    std::vector<Vec3> points_;
    std::vector<SignedDistance> found_;
};

} // namespace anvil
