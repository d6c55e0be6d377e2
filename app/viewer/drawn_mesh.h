// A mesh as the viewer draws it, and the region of it that a drag moves.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/device_surface.h"
#include "engine/mesh/mesh.h"

#include <memory>
#include <span>
#include <vector>

namespace anvil {

/// Which triangles and edges of a mesh's vertices are drawn.
struct DrawnIndices {
    DrawnIndices() = default;
    /// All of the mesh's: triangles, and the polygons' edges, each once; none with a place that is not
    /// finite. @throws DeviceError
    DrawnIndices(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places);
    /// Triangles alone. @throws DeviceError
    DrawnIndices(DeviceState& device, std::span<const uint32_t> corners);

    Buffer triangles;
    Buffer lines;
    uint32_t triangle_indices = 0;
    uint32_t line_indices = 0;
};

struct DrawnRegion;

/// The triangles of a mesh at any of these vertices (`inside`), and the others; nothing where too few are
/// others for it to be worth it. O(mesh). @throws DeviceError
struct SplitTriangles {
    std::shared_ptr<const DrawnIndices> inside;
    std::shared_ptr<const DrawnIndices> outside;
};
SplitTriangles split_triangles(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places,
                               std::span<const uint32_t> vertices);

/// On the device: made once, then only drawn. From any thread.
struct DrawnMesh {
    /// `places` (world) of the mesh's vertices; drawn relative to `centre`, and what is not finite with
    /// its triangles not at all. `editable`: a DrawnRegion may move a part. @throws DeviceError
    DrawnMesh(DeviceState& device, const Mesh& mesh, std::span<const Vec3> places, const Vec3& centre,
              bool editable);

    Vec3 origin{0};
    Box box; ///< world
    Buffer positions;
    Buffer normals;
    DrawnIndices indices;
    Buffer slots; ///< a number per vertex, see shaders/viewer/mesh.vert; empty where not editable
    std::shared_ptr<const DrawnRegion> numbered; ///< whose slots are filled: for who draws, alone
};

/// Each vertex's weight in an edit (largest |phi| of its handles) and its distance from the nearest.
struct RegionMark {
    float weight = 0;
    float distance = -1;
};

/// The part of a mesh that an edit moves, as it stands.
struct DrawnRegion {
    std::vector<uint32_t> vertices; ///< with normals: those that move first
    DeviceSurface surface;
    std::shared_ptr<const Buffer> marks;         ///< of those that move
    std::shared_ptr<const DeformSession> kept;   ///< owns the surface's buffers, if that is on a device
    std::shared_ptr<const DrawnIndices> inside;  ///< the mesh's triangles at any of `vertices`
    std::shared_ptr<const DrawnIndices> outside; ///< all others; both nullptr: not told apart
    Buffer ends;                                 ///< they are ours, if it is not
    Buffer normals;
};

} // namespace anvil
