#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/core/read_file.h"
#include "engine/occluder/level_set_file.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <sstream>

namespace anvil {

namespace {

namespace fs = std::filesystem;

openvdb::GridPtrVec read_grids(const fs::path& file) {
    openvdb::initialize();
    std::istringstream bytes(read_file(file), std::ios::binary);
    // A short read is to end it there: OpenVDB would take what it did not read for a size.
    bytes.exceptions(std::ios::failbit | std::ios::badbit);
    try {
        openvdb::io::Stream stream(bytes, /*delayLoad=*/false);
        return *stream.getGrids();
    } catch (const std::exception& error) {
        throw InputError(file.string() + ": is no VDB file that can be read (" + error.what() +
                         "); export the level set again");
    }
}

bool is_scalar(const openvdb::GridBase& grid) {
    return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>();
}

std::string described(const openvdb::GridBase& grid) {
    const std::string kind = grid.getGridClass() == openvdb::GRID_UNKNOWN
                                 ? "class not said"
                                 : openvdb::GridBase::gridClassToMenuName(grid.getGridClass());
    return "\"" + grid.getName() + "\" (" + kind + ", " + grid.valueType() + ")";
}

std::string listed(const openvdb::GridPtrVec& grids) {
    std::string text;
    for (const auto& grid : grids) {
        text += (text.empty() ? "" : ", ") + described(*grid);
    }
    return text;
}

openvdb::GridBase::Ptr named_grid(const openvdb::GridPtrVec& grids, const std::string& name,
                                  const std::string& file) {
    for (const auto& grid : grids) {
        if (grid->getName() == name) {
            return grid;
        }
    }
    throw InputError(file + ": has no grid \"" + name + "\"; its grids are " + listed(grids));
}

openvdb::GridBase::Ptr only_level_set(const openvdb::GridPtrVec& grids, const std::string& file) {
    openvdb::GridBase::Ptr found;
    for (const auto& grid : grids) {
        if (!is_scalar(*grid) || grid->getGridClass() == openvdb::GRID_FOG_VOLUME) {
            continue;
        }
        if (found) {
            throw InputError(file + ": holds several level sets; name one by \"grid\": " + listed(grids));
        }
        found = grid;
    }
    if (!found) {
        throw InputError(file + ": holds no level set; its grids are " + listed(grids) +
                         "; convert one to a signed distance field first");
    }
    return found;
}

void check(const openvdb::GridBase& grid, const std::string& file, Log& log) {
    const std::string place = file + ": grid " + described(grid);
    if (!is_scalar(grid)) {
        throw InputError(place + ": a level set holds one float or double a voxel; name another by \"grid\"");
    }
    if (grid.getGridClass() == openvdb::GRID_FOG_VOLUME) {
        throw InputError(place + ": a fog volume has densities and no surface; convert it to a level set "
                                 "(Houdini: Convert VDB, Blender: Volume to Mesh)");
    }
    if (grid.getGridClass() != openvdb::GRID_LEVEL_SET) {
        log.warn(place + ": does not say that it is a level set; taken as one, negative inside");
    }
    if (grid.activeVoxelCount() == 0) {
        throw InputError(place + ": is empty; export it again with at least three voxels of narrow band");
    }
    if (!grid.transform().isLinear() || !grid.hasUniformVoxels()) {
        const openvdb::Vec3d size = grid.voxelSize();
        throw InputError(place + ": its voxels are no cubes (" + rounded_text(size.x()) + " x " +
                         rounded_text(size.y()) + " x " + rounded_text(size.z()) +
                         "); resample it to one voxel size, as a level set's distances need it");
    }
}

/// Points in index space: in world space the mesher would round them to float far from the origin.
struct Quads {
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
};

template <typename Grid>
Quads zero_set(const openvdb::GridBase& base) {
    Grid in_index_space(static_cast<const Grid&>(base)); // shares no tree with `base`, but is dropped at once
    in_index_space.setTransform(openvdb::math::Transform::createLinearTransform(1));
    Quads result;
    openvdb::tools::volumeToMesh(in_index_space, result.points, result.triangles, result.quads, 0.0);
    return result;
}

Mesh in_world(const Quads& surface, const openvdb::math::Transform& transform) {
    Mesh mesh;
    for (const openvdb::Vec3s& point : surface.points) {
        const openvdb::Vec3d p = transform.indexToWorld(openvdb::Vec3d(point));
        mesh.positions.emplace_back(p.x(), p.y(), p.z());
    }
    // The mesher's polygons go clockwise seen from outside; a mirrored grid turns them round.
    const bool mirrored = transform.baseMap()->determinant() < 0;
    const auto add = [&](auto polygon, int corners) {
        std::vector<uint32_t> vertices(polygon.asPointer(), polygon.asPointer() + corners);
        if (!mirrored) {
            std::reverse(vertices.begin(), vertices.end());
        }
        mesh.add_polygon(vertices);
    };
    for (openvdb::Vec3I triangle : surface.triangles) {
        add(triangle, 3);
    }
    for (openvdb::Vec4I quad : surface.quads) {
        add(quad, 4);
    }
    triangulate(mesh);
    return mesh;
}

} // namespace

Mesh read_level_set(const fs::path& file, const std::string& grid, Log& log) {
    const openvdb::GridPtrVec grids = read_grids(file);
    if (grids.empty()) {
        throw InputError(file.string() + ": holds no grid; export a level set into it");
    }
    const openvdb::GridBase::Ptr chosen =
        grid.empty() ? only_level_set(grids, file.string()) : named_grid(grids, grid, file.string());
    check(*chosen, file.string(), log);
    const Quads surface = chosen->isType<openvdb::FloatGrid>() ? zero_set<openvdb::FloatGrid>(*chosen)
                                                               : zero_set<openvdb::DoubleGrid>(*chosen);
    Mesh mesh = in_world(surface, chosen->transform());
    if (mesh.triangles.empty()) {
        throw InputError(
            file.string() + ": grid " + described(*chosen) +
            ": has no surface, since its values do not change sign; a level set is negative inside");
    }
    for (const Vec3& p : mesh.positions) {
        if (!is_finite(p)) {
            throw InputError(file.string() + ": grid " + described(*chosen) +
                             ": holds values that are no numbers; export it again");
        }
    }
    return mesh;
}

} // namespace anvil
