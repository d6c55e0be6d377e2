#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/occluder/level_set_file.h"

#include <cmath>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <sstream>

namespace anvil {

namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr double half_width = 3; // of the band, in voxels: what OpenVDB's own filters expect
constexpr int leaf_size = Leaf::DIM;
constexpr int root_size = 128;

/// A cube of voxels at `origin`, by its distance either left out or cut in eight.
std::vector<openvdb::Coord> blocks_around(const Box& box, double voxel) {
    const auto first = [&](double low) {
        return static_cast<int>(std::floor((low / voxel - half_width) / root_size)) * root_size;
    };
    const auto end = [&](double high) { return static_cast<int>(std::ceil(high / voxel + half_width)) + 1; };
    std::vector<openvdb::Coord> blocks;
    for (int x = first(box.low.x); x < end(box.high.x); x += root_size) {
        for (int y = first(box.low.y); y < end(box.high.y); y += root_size) {
            for (int z = first(box.low.z); z < end(box.high.z); z += root_size) {
                blocks.emplace_back(x, y, z);
            }
        }
    }
    return blocks;
}

/// Those of the blocks that the band may reach into.
std::vector<openvdb::Coord> near_surface(const std::vector<openvdb::Coord>& blocks, int size,
                                         const ExactDistance& solid, double voxel) {
    const double half = 0.5 * (size - 1);
    const double reach = (std::sqrt(3.0) * half + half_width) * voxel;
    std::vector<char> near(blocks.size());
    parallel_for(blocks.size(), 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3 centre = Vec3(blocks[i].x(), blocks[i].y(), blocks[i].z()) + Vec3(half);
            near[i] = std::abs(solid.at(voxel * centre).distance) <= reach;
        }
    });
    std::vector<openvdb::Coord> kept;
    for (size_t i = 0; i < blocks.size(); ++i) {
        if (near[i]) {
            kept.push_back(blocks[i]);
        }
    }
    return kept;
}

std::vector<openvdb::Coord> halved(const std::vector<openvdb::Coord>& blocks, int size) {
    std::vector<openvdb::Coord> children;
    for (const openvdb::Coord& block : blocks) {
        for (int corner = 0; corner < 8; ++corner) {
            children.push_back(block.offsetBy(corner & 1 ? size / 2 : 0, corner & 2 ? size / 2 : 0,
                                              corner & 4 ? size / 2 : 0));
        }
    }
    return children;
}

std::vector<openvdb::Coord> band_leaves(const ExactDistance& solid, double voxel) {
    std::vector<openvdb::Coord> blocks = blocks_around(solid.bounds(), voxel);
    for (int size = root_size;; size /= 2) {
        blocks = near_surface(blocks, size, solid, voxel);
        if (size == leaf_size) {
            return blocks;
        }
        blocks = halved(blocks, size);
    }
}

void append_points(std::vector<Vec3>& points, const openvdb::Coord& origin, double voxel) {
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
        const openvdb::Coord at = Leaf::offsetToLocalCoord(i) + origin;
        points.push_back(voxel * Vec3(at.x(), at.y(), at.z()));
    }
}

std::unique_ptr<Leaf> filled_leaf(const openvdb::Coord& origin, std::span<const SignedDistance> found,
                                  double voxel) {
    const auto background = static_cast<float>(half_width * voxel);
    auto leaf = std::make_unique<Leaf>(origin, background, false);
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
        const double distance = found[i].distance;
        if (std::abs(distance) < half_width * voxel) {
            leaf->setValueOn(i, static_cast<float>(distance));
        } else {
            leaf->setValueOff(i, distance < 0 ? -background : background);
        }
    }
    return leaf;
}

/// The leaves at these places.
std::vector<std::unique_ptr<Leaf>> filled_leaves(std::span<const openvdb::Coord> origins,
                                                 DistanceTracer& tracer, double voxel) {
    std::vector<Vec3> points;
    for (const openvdb::Coord& origin : origins) {
        append_points(points, origin, voxel);
    }
    std::vector<SignedDistance> found(points.size());
    tracer.trace(points, found);
    std::vector<std::unique_ptr<Leaf>> leaves;
    for (size_t i = 0; i < origins.size(); ++i) {
        leaves.push_back(filled_leaf(origins[i], std::span(found).subspan(i * Leaf::SIZE), voxel));
    }
    return leaves;
}

void fill(openvdb::FloatTree& tree, const std::vector<openvdb::Coord>& origins, const ExactDistance& solid,
          double voxel, Progress& progress, SearchDevice* device) {
    constexpr size_t batch = 512;
    const auto on_device = device != nullptr ? solid.tracer_with(*device) : nullptr;
    std::vector<std::unique_ptr<Leaf>> leaves;
    for (size_t first = 0; first < origins.size(); first += batch) {
        progress.report("bake", static_cast<double>(first) / static_cast<double>(origins.size()));
        const auto some = std::span(origins).subspan(first, std::min(batch, origins.size() - first));
        if (on_device) {
            leaves = filled_leaves(some, *on_device, voxel);
        } else {
            leaves.resize(some.size());
            parallel_for(some.size(), 1, [&](size_t begin, size_t end) {
                auto part = filled_leaves(some.subspan(begin, end - begin), *solid.tracer(), voxel);
                std::move(part.begin(), part.end(), leaves.begin() + static_cast<std::ptrdiff_t>(begin));
            });
        }
        for (std::unique_ptr<Leaf>& leaf : leaves) {
            if (!leaf->isInactive()) {
                tree.addLeaf(leaf.release()); // the tree deletes it
            }
        }
    }
}

void check_size(const Box& box, double voxel) {
    constexpr double most_voxels = 1e4; // along a side
    constexpr double largest_index = 1e9;
    if (!(box.diagonal() / voxel < most_voxels)) {
        throw InputError(
            "a level set of more than 10000 voxels along a side does not fit; take larger voxels");
    }
    if (!(std::max(glm::length(box.low), glm::length(box.high)) / voxel < largest_index)) {
        throw InputError("the solid lies too far from the origin for voxels of its size; move it nearer");
    }
}

std::string as_file(const openvdb::FloatGrid::Ptr& grid) {
    std::ostringstream bytes(std::ios::binary);
    openvdb::io::Stream stream(bytes);
    // Zip is part of every OpenVDB; Blosc is not.
    stream.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    stream.write({grid});
    return std::move(bytes).str();
}

} // namespace

void write_level_set(const std::filesystem::path& file, const ExactDistance& solid, double voxel,
                     Progress& progress, SearchDevice* device) {
    const Box box = solid.bounds();
    if (box.empty() || !is_finite(box.low) || !is_finite(box.high) || !(box.diagonal() > 0)) {
        throw InputError("only a bounded solid with an extent can be baked into a level set");
    }
    check_size(box, voxel);
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(static_cast<float>(half_width * voxel));
    grid->setName("surface");
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->setCreator("Anvil");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    fill(grid->tree(), band_leaves(solid, voxel), solid, voxel, progress, device);
    if (grid->activeVoxelCount() == 0) {
        throw InputError("the solid is thinner than its voxels show; raise the field's \"resolution\"");
    }
    openvdb::tools::signedFloodFill(grid->tree());
    grid->addStatsMetadata();
    write_file_atomically(file, as_file(grid));
}

} // namespace anvil
