#include "engine/occluder/brick_sampler.h"

#include "engine/occluder/adaptive_field.h"

#include <cmath>

namespace anvil {

namespace {

// Voxels around the surface where the finest level is tried before a coarser one is found good enough, so
// that nothing as small as a voxel slips through between the samples of coarse levels.
constexpr double surface_reach = 2;
// How much larger the error between the tested points may be. Where the nearest surface changes sides the
// distance has a crease: one that runs through a cell at a quarter of its width is off by up to 1.5 times as
// much as in the centre, and farther out by up to twice.
constexpr double beside_centre = 2;
constexpr double beside_samples = 1.2;

/// All of a parent's octants' samples are a lattice of this side.
constexpr int family_side = 2 * brick_cells + 1;

constexpr int family_size = family_side * family_side * family_side;

int family_index(const CellIndex& place) {
    return place.x + family_side * (place.y + family_side * place.z);
}

CellIndex family_place(int index) {
    return {index % family_side, index / family_side % family_side, index / (family_side * family_side)};
}

int octant_of(const CellIndex& cell) {
    constexpr int half = brick_cells / 2;
    return (cell.x >= half ? 1 : 0) + (cell.y >= half ? 2 : 0) + (cell.z >= half ? 4 : 0);
}

/// A point within reach of the surface has a sample, within half a cell's diagonal, that shows it.
uint8_t octants_near_surface(const Brick& brick) {
    const double reach = surface_reach + 0.5 * std::sqrt(3.0) * (1 << brick.level);
    constexpr int half = brick_cells / 2;
    uint8_t near = 0;
    for (int octant = 0; octant < 8; ++octant) {
        const CellIndex low(octant & 1 ? half : 0, octant & 2 ? half : 0, octant & 4 ? half : 0);
        for (int i = 0; i < 27; ++i) {
            const CellIndex s = low + CellIndex(i % 3, i / 3 % 3, i / 9);
            if (std::abs(brick.samples[sample_index(s)].w) <= reach) {
                near |= static_cast<uint8_t>(1 << octant);
            }
        }
    }
    return near;
}

Vec3 cells_at(const Brick& brick, const Vec3& within) {
    return Vec3(brick.origin()) + static_cast<double>(1 << brick.level) * within;
}

/// visit(index in the family's lattice, sample) for each sample of a child.
template <class AnyBrick, class Visit>
void for_samples(const Brick& parent, AnyBrick& child, const Visit& visit) {
    const CellIndex low = (child.place - parent.place * 2) * brick_cells;
    for (int i = 0; i < brick_samples; ++i) {
        visit(family_index(low + sample_place(i)), child.samples[i]);
    }
}

/// visit(index in the family's lattice) for each of the child's samples in the middle of a parent's cell.
template <class Visit>
void for_centres(const Brick& parent, const Brick& child, const Visit& visit) {
    for_samples(parent, child, [&](int at, const glm::vec4&) {
        const CellIndex place = family_place(at);
        if ((place.x & place.y & place.z & 1) != 0) {
            visit(at);
        }
    });
}

} // namespace

Vec3 BrickSampler::point(const Brick& brick, const Vec3& within) const {
    return layout_.point(cells_at(brick, within));
}

glm::vec4 BrickSampler::found_sample(size_t i) const {
    return {glm::vec3(found_[i].normal), static_cast<float>(found_[i].distance / layout_.voxel)};
}

void BrickSampler::trace() {
    found_.resize(points_.size());
    solid_.trace(points_, found_);
}

void BrickSampler::sample(Brick& brick) {
    points_.clear();
    for (int i = 0; i < brick_samples; ++i) {
        points_.push_back(point(brick, Vec3(sample_place(i))));
    }
    trace();
    for (int i = 0; i < brick_samples; ++i) {
        brick.samples[i] = found_sample(i);
    }
}

void BrickSampler::begin_family(const Brick& parent) {
    lattice_.resize(family_size);
    known_.assign(family_size, false);
    for (int i = 0; i < brick_samples; ++i) {
        const int at = family_index(2 * sample_place(i));
        lattice_[at] = parent.samples[i];
        known_[at] = true;
    }
}

/// What of these places in the family's lattice is not known yet.
void BrickSampler::sample_lattice(const Brick& parent, std::span<const int> places) {
    points_.clear();
    std::vector<int> open;
    for (const int at : places) {
        if (!known_[at]) {
            known_[at] = true;
            open.push_back(at);
            points_.push_back(point(parent, 0.5 * Vec3(family_place(at))));
        }
    }
    trace();
    for (size_t i = 0; i < open.size(); ++i) {
        lattice_[open[i]] = found_sample(i);
    }
}

void BrickSampler::sample_children(const Brick& parent, std::span<Brick> children) {
    begin_family(parent);
    finish_children(parent, children, {});
}

void BrickSampler::sample_finest_children(const Brick& parent, std::span<Brick> children,
                                          std::span<double> errors) {
    begin_family(parent);
    std::vector<int> centres;
    for (const Brick& child : children) {
        for_centres(parent, child, [&](int at) { centres.push_back(at); });
    }
    sample_lattice(parent, centres);
    for (size_t i = 0; i < children.size(); ++i) {
        errors[i] = spares_centres(parent, children[i]) ? -1 : 0;
    }
    finish_children(parent, children, errors);
    for (size_t i = 0; i < children.size(); ++i) {
        if (errors[i] == 0 && spares(parent, children[i])) {
            errors[i] = -1;
        }
    }
}

/// Whether the parent interpolates well enough in the middle of its own cells, where it is off most.
bool BrickSampler::spares_centres(const Brick& parent, const Brick& child) const {
    bool good = true;
    for_centres(parent, child, [&](int at) {
        const double distance = lattice_[at].w;
        const double other = parent.interpolated(cells_at(parent, 0.5 * Vec3(family_place(at)))).w;
        good = good && beside_centre * std::abs(other - distance) <= adaptive_tolerance(distance);
    });
    return good;
}

/// Those without a negative error.
void BrickSampler::finish_children(const Brick& parent, std::span<Brick> children,
                                   std::span<const double> errors) {
    std::vector<bool> wanted(family_size, false);
    for (size_t i = 0; i < children.size(); ++i) {
        if (errors.empty() || errors[i] >= 0) {
            for_samples(parent, children[i], [&](int at, const glm::vec4&) { wanted[at] = true; });
        }
    }
    std::vector<int> places;
    for (int at = 0; at < family_size; ++at) {
        if (wanted[at]) {
            places.push_back(at);
        }
    }
    sample_lattice(parent, places);
    for (Brick& child : children) {
        for_samples(parent, child, [&](int at, glm::vec4& sample) { sample = lattice_[at]; });
    }
}

/// Finds the distances at the centres of cells for which wanted(index of the brick, cell) is true.
template <class Wanted>
void BrickSampler::test_cells(std::span<const Brick> bricks, const Wanted& wanted) {
    constexpr int cells = brick_cells * brick_cells * brick_cells;
    points_.clear();
    tests_.clear();
    for (size_t b = 0; b < bricks.size(); ++b) {
        for (int i = 0; i < cells; ++i) {
            const CellIndex cell(i % brick_cells, i / brick_cells % brick_cells,
                                 i / (brick_cells * brick_cells));
            if (wanted(b, cell)) {
                tests_.push_back({b, cell});
                points_.push_back(point(bricks[b], Vec3(cell) + Vec3(0.5)));
            }
        }
    }
    trace();
}

/// Of test i, in voxels.
double BrickSampler::error(std::span<const Brick> bricks, size_t i) const {
    const auto& [b, cell] = tests_[i];
    const double interpolated = bricks[b].interpolated(cells_at(bricks[b], Vec3(cell) + Vec3(0.5))).w;
    return std::abs(interpolated - found_[i].distance / layout_.voxel);
}

void BrickSampler::find_octants_to_refine(std::span<Brick> bricks) {
    for (Brick& brick : bricks) {
        brick.refined = octants_near_surface(brick);
    }
    test_cells(bricks, [&](size_t b, const CellIndex& cell) {
        return (bricks[b].refined >> octant_of(cell) & 1) == 0;
    });
    for (size_t i = 0; i < tests_.size(); ++i) {
        if (beside_centre * error(bricks, i) > adaptive_tolerance(found_[i].distance / layout_.voxel)) {
            bricks[tests_[i].brick].refined |= static_cast<uint8_t>(1 << octant_of(tests_[i].cell));
        }
    }
}

void BrickSampler::find_surface_errors(std::span<const Brick> bricks, std::span<double> errors) {
    test_cells(bricks, [&](size_t b, const CellIndex& cell) {
        const CellIndex& p = bricks[b].place;
        const int phase = (p.x + 2 * p.y + 4 * p.z) & 7; // all cells take their turn from brick to brick
        const int turn = (cell.x & 1) + 2 * (cell.y & 1) + 4 * (cell.z & 1);
        return turn == phase && errors[b] >= 0 &&
               std::abs(bricks[b].samples[sample_index(cell)].w) < surface_reach;
    });
    for (size_t i = 0; i < tests_.size(); ++i) {
        double& worst = errors[tests_[i].brick];
        worst = std::max(worst, error(bricks, i));
    }
}

bool BrickSampler::spares(const Brick& coarser, const Brick& brick) {
    for (int i = 0; i < brick_samples; ++i) {
        const double distance = brick.samples[i].w;
        const double other = coarser.interpolated(Vec3(brick.origin() + (sample_place(i) << brick.level))).w;
        if (beside_samples * std::abs(other - distance) > adaptive_tolerance(distance)) {
            return false;
        }
    }
    return true;
}

} // namespace anvil
