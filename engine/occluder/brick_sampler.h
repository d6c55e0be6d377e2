// Fills bricks with samples and finds where they are too coarse; internal to engine/occluder.
#pragma once

#include "engine/occluder/brick_tree.h"

#include <span>
#include <vector>

namespace anvil {

/// Asks for the distances of many bricks at once, which is what makes them cheap. One object a thread.
class BrickSampler {
  public:
    BrickSampler(const ExactDistance& solid, const BrickLayout& layout) : solid_(solid), layout_(layout) {}

    void sample(Brick& brick);

    /// Bricks that refine octants of one parent: they have samples in common, with each other and with the
    /// parent.
    void sample_children(const Brick& parent, std::span<Brick> children);

    /// The same on the finest level: leaves out, with -1 in `errors`, those that the parent spares. It is
    /// held against the samples in the middle of its cells first; most that it spares cost no more than
    /// these.
    void sample_finest_children(const Brick& parent, std::span<Brick> children, std::span<double> errors);

    /// Sets `refined` of sampled bricks: the octants that the surface is near to, or that they interpolate
    /// too badly.
    void find_octants_to_refine(std::span<Brick> bricks);

    /// Largest interpolation error of each brick at some of its cells' centres near the surface, in voxels.
    /// Negative entries of `errors` stay, and cost nothing.
    void find_surface_errors(std::span<const Brick> bricks, std::span<double> errors);

  private:
    struct Test {
        size_t brick;
        CellIndex cell;
    };

    /// Whether the coarser brick interpolates well enough at all of the other's samples.
    static bool spares(const Brick& coarser, const Brick& brick);
    bool spares_centres(const Brick& parent, const Brick& child) const;
    void begin_family(const Brick& parent);
    void sample_lattice(const Brick& parent, std::span<const int> places);
    void finish_children(const Brick& parent, std::span<Brick> children, std::span<const double> errors);
    Vec3 point(const Brick& brick, const Vec3& within) const;
    glm::vec4 found_sample(size_t i) const;
    void trace();
    template <class Wanted>
    void test_cells(std::span<const Brick> bricks, const Wanted& wanted);
    double error(std::span<const Brick> bricks, size_t i) const;

    const ExactDistance& solid_;
    const BrickLayout& layout_;
    std::vector<Test> tests_;
    std::vector<glm::vec4> lattice_; ///< samples of a family
    std::vector<bool> known_;        ///< which of them
    std::vector<Vec3> points_;
    std::vector<SignedDistance> found_;
};

} // namespace anvil
