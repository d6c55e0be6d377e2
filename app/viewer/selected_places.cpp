#include "app/viewer/selected_places.h"

#include "engine/edit/face_address.h"

#include <algorithm>

namespace anvil {

namespace {

/// The first triangle of each vertex; no_index where none is.
std::vector<uint32_t> first_triangles(const Mesh& mesh) {
    std::vector<uint32_t> first(mesh.vertex_count(), no_index);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const uint32_t v : mesh.triangles[t]) {
            first[v] = std::min(first[v], t);
        }
    }
    return first;
}

SurfacePoint corner_of(const Mesh& mesh, uint32_t triangle, uint32_t vertex) {
    const Triangle& corners = mesh.triangles[triangle];
    SurfacePoint point{triangle, Vec3(0), vertex};
    point.barycentric[static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin())] =
        1;
    return point;
}

Vec3 centre_of(std::span<const uint32_t> corners, std::span<const Vec3> positions) {
    Vec3 sum(0);
    for (const uint32_t v : corners) {
        sum += positions[v];
    }
    return sum / static_cast<double>(corners.size());
}

/// The file's face that a face of the surface is or is part of.
uint32_t file_face(const SurfaceVersion& surface, size_t face) {
    const std::vector<uint32_t>& roots = surface.history->roots();
    if (roots.empty()) {
        return static_cast<uint32_t>(face);
    }
    SurfacePoint point{roots[surface.mesh->first_triangle(face)], Vec3(1, 0, 0)};
    return face_address(*surface.file, point).face;
}

} // namespace

std::vector<PickedPlace> places_of(const SurfaceVersion& surface, std::span<const uint32_t> vertices,
                                   const PickSurface& pick) {
    const Mesh& mesh = *surface.mesh;
    const std::vector<uint32_t> first = first_triangles(mesh);
    std::vector<PickedPlace> places;
    for (const uint32_t v : vertices) {
        if (v < surface.file->vertex_count()) {
            places.push_back({VertexAddress{v}, surface.positions[v], Vec3(0)});
        } else if (first[v] != no_index) {
            places.push_back(place_of(pick.at(corner_of(mesh, first[v], v))));
        }
    }
    return places;
}

SelectedPlaces faces_and_places_of(const SurfaceVersion& surface, const Selection& selection,
                                   const PickSurface& pick) {
    const Mesh& mesh = *surface.mesh;
    SelectedPlaces result;
    std::vector<bool> covered(mesh.vertex_count(), false);
    std::vector<bool> known(surface.file->polygon_count(), false);
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const std::span<const uint32_t> corners = mesh.polygon(f);
        if (!selection.selects(corners)) {
            continue;
        }
        for (const uint32_t v : corners) {
            covered[v] = true;
        }
        const uint32_t face = file_face(surface, f);
        if (!known[face]) {
            known[face] = true;
            result.faces.push_back({{face}, centre_of(corners, surface.positions)});
        }
    }
    std::vector<uint32_t> single = selection.selected_vertices();
    std::erase_if(single, [&](uint32_t v) { return covered[v]; });
    result.places = places_of(surface, single, pick);
    return result;
}

} // namespace anvil
