#include "engine/edit/face_address.h"

namespace anvil {

FaceAddress face_address(const Mesh& mesh, const SurfacePoint& point) {
    size_t low = 0;
    size_t high = mesh.polygon_count();
    while (high - low > 1) { // first_triangle() ascends
        const size_t middle = (low + high) / 2;
        (mesh.first_triangle(middle) <= point.triangle ? low : high) = middle;
    }
    const Vec3& b = point.barycentric;
    return {static_cast<uint32_t>(low), static_cast<uint32_t>(point.triangle - mesh.first_triangle(low)),
            checked_barycentric({b.x, b.y, b.z})};
}

} // namespace anvil
