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
// Voxels outside and inside the surface where vertices are held and slide: what a coarser brick is off there
// adds up along their way, to more than the field's tolerance if each brick used that up.
constexpr double contact_outside = 1.5;
constexpr double contact_inside = 0.5;
constexpr double contact_tolerance = 0.01;
// What normals may be off where a soft influence is at its strongest; farther away by as much more as it is
// weaker, for one a little narrower than the default. A vertex that it slows all but stands still while the
// pushes add up: their directions are what its results hang on, far more than how strong they are.
constexpr double pushing_normal = 0.055;
constexpr double pushing_width = 0.8;

/// All samples of a cluster are a lattice of this side: four children's.
constexpr int lattice_side = 4 * brick_cells + 1;

constexpr int lattice_size = lattice_side * lattice_side * lattice_side;

int lattice_index(const CellIndex& place) {
    return place.x + lattice_side * (place.y + lattice_side * place.z);
}

CellIndex lattice_place(int index) {
    return {index % lattice_side, index / lattice_side % lattice_side, index / (lattice_side * lattice_side)};
}

/// What a coarser brick may be off where the finest one shows this distance, in voxels.
double spared_tolerance(double distance) {
    const bool contact = distance > -contact_inside && distance < contact_outside;
    return contact ? contact_tolerance : adaptive_tolerance(distance);
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

} // namespace

bool share_cluster(const Brick& parent, const Brick& other) {
    return parent.level == other.level && parent.place >> 1 == other.place >> 1;
}

template <class AnyBrick, class Visit>
void BrickSampler::for_samples(AnyBrick& child, const Visit& visit) const {
    const CellIndex low = (child.place - low_) * brick_cells;
    for (int i = 0; i < brick_samples; ++i) {
        visit(lattice_index(low + sample_place(i)), child.samples[i]);
    }
}

template <class Visit>
void BrickSampler::for_centres(const Brick& child, const Visit& visit) const {
    for_samples(child, [&](int at, const glm::vec4&) {
        const CellIndex place = lattice_place(at);
        if ((place.x & place.y & place.z & 1) != 0) {
            visit(at);
        }
    });
}

Vec3 BrickSampler::point(const Brick& brick, const Vec3& within) const {
    return layout_.point(cells_at(brick, within));
}

/// Of a place in the lattice, in finest cells.
Vec3 BrickSampler::lattice_cells(int at) const {
    return Vec3((low_ * brick_cells + lattice_place(at)) << level_);
}

glm::vec4 BrickSampler::found_sample(size_t i) const {
    return {glm::vec3(found_[i].normal), static_cast<float>(found_[i].distance / layout_.voxel)};
}

void BrickSampler::begin(const Cluster& cluster, std::span<double> errors) {
    cluster_ = cluster;
    errors_ = errors;
    const Brick& first = cluster.children.front();
    low_ = cluster.parents.empty() ? first.place : cluster.parents.front()->place >> 1 << 2;
    level_ = first.level;
    share_samples();
    if (errors.empty() || cluster.parents.empty()) {
        ask_samples();
        round_ = Round::samples;
    } else {
        ask_centres();
        round_ = Round::centres;
    }
    found_.resize(points_.size());
}

bool BrickSampler::advance() {
    switch (round_) {
    case Round::centres:
        take_samples();
        spare_by_centres();
        ask_samples();
        round_ = Round::samples;
        break;
    case Round::samples:
        take_samples();
        for (Brick& child : cluster_.children) {
            for_samples(child, [&](int at, glm::vec4& sample) { sample = lattice_[at]; });
        }
        if (errors_.empty()) {
            ask_octants();
        } else {
            spare_by_samples();
            ask_surface_errors();
        }
        round_ = Round::tests;
        break;
    case Round::tests:
        if (errors_.empty()) {
            take_octants();
        } else {
            take_surface_errors();
        }
        return false;
    }
    found_.resize(points_.size());
    return true;
}

/// What the parents know already.
void BrickSampler::share_samples() {
    lattice_.resize(lattice_size);
    known_.assign(lattice_size, false);
    const Brick* last = nullptr;
    for (const Brick* parent : cluster_.parents) {
        if (parent == last) {
            continue;
        }
        last = parent;
        const CellIndex low = (parent->place * 2 - low_) * brick_cells;
        for (int i = 0; i < brick_samples; ++i) {
            const int at = lattice_index(low + 2 * sample_place(i));
            lattice_[at] = parent->samples[i];
            known_[at] = true;
        }
    }
}

/// For what of these places in the lattice is not known yet.
void BrickSampler::ask(std::span<const int> places) {
    points_.clear();
    asked_.clear();
    for (const int at : places) {
        if (!known_[at]) {
            known_[at] = true;
            asked_.push_back(at);
            points_.push_back(layout_.point(lattice_cells(at)));
        }
    }
}

void BrickSampler::take_samples() {
    for (size_t i = 0; i < asked_.size(); ++i) {
        lattice_[asked_[i]] = found_sample(i);
    }
}

void BrickSampler::ask_centres() {
    std::vector<int> centres;
    for (const Brick& child : cluster_.children) {
        for_centres(child, [&](int at) { centres.push_back(at); });
    }
    ask(centres);
}

void BrickSampler::ask_samples() {
    std::vector<int> places;
    for (size_t i = 0; i < cluster_.children.size(); ++i) {
        if (!is_spared(i)) {
            for_samples(cluster_.children[i], [&](int at, const glm::vec4&) { places.push_back(at); });
        }
    }
    ask(places);
}

void BrickSampler::spare_by_centres() {
    for (size_t i = 0; i < cluster_.children.size(); ++i) {
        errors_[i] = spares_centres(*cluster_.parents[i], cluster_.children[i]) ? -1 : 0;
    }
}

void BrickSampler::spare_by_samples() {
    for (size_t i = 0; i < cluster_.parents.size(); ++i) {
        if (!is_spared(i) && spares(*cluster_.parents[i], cluster_.children[i])) {
            errors_[i] = -1;
        }
    }
}

/// Whether the parent interpolates well enough in the middle of its own cells, where it is off most.
bool BrickSampler::spares_centres(const Brick& parent, const Brick& child) const {
    bool good = true;
    for_centres(child, [&](int at) {
        good = good && is_good(parent.interpolated(lattice_cells(at)), lattice_[at], beside_centre);
    });
    return good;
}

/// For the distances at the centres of cells for which wanted(index of the brick, cell) is true.
template <class Wanted>
void BrickSampler::ask_cells(const Wanted& wanted) {
    constexpr int cells = brick_cells * brick_cells * brick_cells;
    points_.clear();
    tests_.clear();
    for (size_t b = 0; b < cluster_.children.size(); ++b) {
        for (int i = 0; i < cells; ++i) {
            const CellIndex cell(i % brick_cells, i / brick_cells % brick_cells,
                                 i / (brick_cells * brick_cells));
            if (wanted(b, cell)) {
                tests_.push_back({b, cell});
                points_.push_back(point(cluster_.children[b], Vec3(cell) + Vec3(0.5)));
            }
        }
    }
}

/// At test i.
glm::dvec4 BrickSampler::interpolated(size_t i) const {
    const auto& [b, cell] = tests_[i];
    const Brick& brick = cluster_.children[b];
    return brick.interpolated(cells_at(brick, Vec3(cell) + Vec3(0.5)));
}

void BrickSampler::ask_octants() {
    for (Brick& brick : cluster_.children) {
        brick.refined = octants_near_surface(brick);
    }
    ask_cells([&](size_t b, const CellIndex& cell) {
        return (cluster_.children[b].refined >> octant_of(cell) & 1) == 0;
    });
}

void BrickSampler::take_octants() {
    for (size_t i = 0; i < tests_.size(); ++i) {
        if (!is_good(interpolated(i), found_sample(i), beside_centre)) {
            cluster_.children[tests_[i].brick].refined |=
                static_cast<uint8_t>(1 << octant_of(tests_[i].cell));
        }
    }
}

void BrickSampler::ask_surface_errors() {
    ask_cells([&](size_t b, const CellIndex& cell) {
        const Brick& brick = cluster_.children[b];
        const CellIndex& p = brick.place;
        const int phase = (p.x + 2 * p.y + 4 * p.z) & 7; // all cells take their turn from brick to brick
        const int turn = (cell.x & 1) + 2 * (cell.y & 1) + 4 * (cell.z & 1);
        return turn == phase && !is_spared(b) &&
               std::abs(brick.samples[sample_index(cell)].w) < surface_reach;
    });
}

void BrickSampler::take_surface_errors() {
    for (size_t i = 0; i < tests_.size(); ++i) {
        double& worst = errors_[tests_[i].brick];
        worst = std::max(worst, std::abs(interpolated(i).w - found_[i].distance / layout_.voxel));
    }
}

bool BrickSampler::spares(const Brick& coarser, const Brick& brick) const {
    for (int i = 0; i < brick_samples; ++i) {
        const Vec3 cells(brick.origin() + (sample_place(i) << brick.level));
        if (!is_good(coarser.interpolated(cells), brick.samples[i], beside_samples)) {
            return false;
        }
    }
    return true;
}

bool BrickSampler::is_good(const glm::dvec4& interpolated, const glm::dvec4& truth, double beside) const {
    if (beside * std::abs(interpolated.w - truth.w) > spared_tolerance(truth.w)) {
        return false;
    }
    const double tolerance = normal_tolerance(truth.w);
    const double size = glm::length(Vec3(interpolated));
    return tolerance >= 2 || (size > 0 && glm::length(Vec3(interpolated) / size - Vec3(truth)) <= tolerance);
}

/// Length of the difference; 2 and more: any. Inside nothing pushes but contact.
double BrickSampler::normal_tolerance(double distance) const {
    const double x = distance / (pushing_width * layout_.soft_width);
    return distance < 0 ? 2 : pushing_normal * std::exp(std::min(x * x, 10.0));
}

} // namespace anvil
