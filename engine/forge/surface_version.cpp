#include "engine/forge/surface_version.h"

#include "engine/forge/kept_solvers.h"
#include "engine/forge/volume.h"

namespace anvil {

namespace {

template <class Value>
size_t bytes(const std::vector<Value>& values) {
    return values.capacity() * sizeof(Value);
}

size_t bytes(const std::vector<bool>& bits) {
    return bits.capacity() / 8;
}

size_t bytes(const CornerLayer& layer) {
    return bytes(layer.values) + bytes(layer.index);
}

size_t bytes(const std::vector<Column>& columns) {
    size_t sum = 0;
    for (const Column& column : columns) {
        sum += bytes(column.values);
    }
    return sum;
}

size_t bytes(const Mesh& mesh) {
    return bytes(mesh.positions) + bytes(mesh.polygon_begin) + bytes(mesh.corners) + bytes(mesh.triangles) +
           bytes(mesh.vertex_columns) + bytes(mesh.polygon_columns) + bytes(mesh.texture_coordinates) +
           bytes(mesh.corner_normals) + bytes(mesh.groups);
}

size_t bytes(const EditReport& report) {
    size_t sum = 0;
    for (const ContactList& list : report.contacts) {
        sum += bytes(list.vertices) + bytes(list.triangles);
    }
    return sum;
}

} // namespace

SurfaceVersion first_version(std::shared_ptr<const Mesh> file) {
    SurfaceVersion version;
    version.history = std::make_shared<const RefinementHistory>(*file);
    version.frame = local_frame(*file);
    version.positions = file->positions;
    version.moved.assign(file->vertex_count(), false);
    version.weights.assign(file->vertex_count(), 0.0F);
    version.touching.assign(file->vertex_count(), false);
    if (is_closed(*file)) {
        version.volume = enclosed_volume(*file, version.positions);
    }
    version.number = new_surface_number();
    version.mesh = file;
    version.file = std::move(file);
    return version;
}

size_t own_bytes(const SurfaceVersion& version) {
    return sizeof version + bytes(version.positions) + bytes(version.moved) + bytes(version.weights) +
           bytes(version.touching) + bytes(version.report);
}

size_t mesh_bytes(const SurfaceVersion& version) {
    return bytes(*version.mesh) + bytes(version.history->parents()) + bytes(version.history->roots());
}

} // namespace anvil
