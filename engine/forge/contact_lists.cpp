#include "engine/forge/contact_lists.h"

#include "engine/occluder/occluder_motion.h"

#include <algorithm>

namespace anvil {

namespace {

/// Triangles with a corner in the region, ascending.
std::vector<uint32_t> triangles_around(const EditRegion& region, const Mesh& mesh) {
    std::vector<bool> in_region(mesh.vertex_count(), false);
    for (const uint32_t v : region.vertices) {
        in_region[v] = true;
    }
    std::vector<uint32_t> places;
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (in_region[t[0]] || in_region[t[1]] || in_region[t[2]]) {
            places.push_back(i);
        }
    }
    return places;
}

} // namespace

ContactReport contact_of(const DeformInput& input, const EditEnds& ends, const EditRegion& region,
                         const Mesh& mesh, std::span<const Vec3> positions, const Vec3& origin) {
    ContactReport contact;
    contact.started_inside = static_cast<size_t>(std::count(ends.inside.begin(), ends.inside.end(), true));
    contact.finished_on_cpu = ends.finished_on_cpu;
    const OccluderSet set = at_end(input.occluders);
    measure_vertices(set, ends.ends, ends.inside, contact);
    const std::vector<uint32_t> places = triangles_around(region, mesh);
    std::vector<Triangle> triangles;
    triangles.reserve(places.size());
    for (const uint32_t place : places) {
        triangles.push_back(mesh.triangles[place]);
    }
    measure_triangles(set, positions, origin, triangles, contact);
    for (OccluderContact& occluder : contact.occluders) {
        for (uint32_t& triangle : occluder.triangles) {
            triangle = places[triangle];
        }
    }
    return contact;
}

std::vector<ContactList> contact_lists(const ContactReport& contact, const std::vector<std::string>& names,
                                       const EditRegion& region, const Mesh& mesh) {
    std::vector<ContactList> lists;
    for (size_t k = 0; k < names.size(); ++k) {
        ContactList list{names[k], {}, {}};
        for (const uint32_t point : contact.occluders[k].points) {
            list.vertices.push_back(region.vertices[point]);
        }
        std::sort(list.vertices.begin(), list.vertices.end());
        uint32_t face = 0;
        for (const uint32_t triangle : contact.occluders[k].triangles) {
            while (mesh.first_triangle(face + size_t{1}) <= triangle) {
                ++face;
            }
            list.triangles.push_back({face, triangle - static_cast<uint32_t>(mesh.first_triangle(face))});
        }
        lists.push_back(std::move(list));
    }
    return lists;
}

} // namespace anvil
