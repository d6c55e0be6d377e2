#include "engine/forge/region_fans.h"

namespace anvil {

namespace {

void number_around(size_t first, size_t last, const Mesh& mesh, const Incidence& incidence,
                   VertexNumbers& numbers) {
    for (size_t i = first; i < last; ++i) {
        for (const uint32_t t : incidence.at(numbers.vertices()[i])) {
            for (const uint32_t v : mesh.triangles[t]) {
                numbers.add(v);
            }
        }
    }
}

kernel::f64::FanCorner others(const Triangle& t, uint32_t vertex, const VertexNumbers& numbers) {
    const size_t at = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    return {numbers[t[(at + 1) % 3]], numbers[t[(at + 2) % 3]]};
}

} // namespace

RegionFans fans_around(std::span<const uint32_t> region, const Mesh& mesh, const Incidence& incidence,
                       std::span<const Vec3> positions, const Vec3& origin, VertexNumbers& numbers) {
    for (const uint32_t v : region) {
        numbers.add(v);
    }
    number_around(0, region.size(), mesh, incidence, numbers);
    const size_t count = numbers.vertices().size();
    number_around(region.size(), count, mesh, incidence, numbers); // corners of the outer ones' triangles

    RegionFans result;
    const std::vector<uint32_t>& vertices = numbers.vertices();
    result.vertices.assign(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count));
    NormalFans& fans = result.fans;
    fans.rim.reserve(vertices.size() - region.size());
    for (size_t i = region.size(); i < vertices.size(); ++i) {
        fans.rim.push_back(positions[vertices[i]] - origin);
    }
    fans.begin.reserve(count + 1);
    fans.begin.push_back(0);
    for (const uint32_t v : result.vertices) {
        for (const uint32_t t : incidence.at(v)) {
            fans.corners.push_back(others(mesh.triangles[t], v, numbers));
        }
        fans.begin.push_back(static_cast<uint32_t>(fans.corners.size()));
    }
    numbers.clear();
    return result;
}

} // namespace anvil
