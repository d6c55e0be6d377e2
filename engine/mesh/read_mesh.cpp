#include "engine/core/error.h"
#include "engine/core/read_file.h"
#include "engine/mesh/health.h"
#include "engine/mesh/mesh_format.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_source.h"
#include "engine/mesh/precision.h"

namespace anvil {

void MeshSource::fail(const std::string& cause, const std::string& mend) const {
    throw InputError(name + ": " + cause + "; " + mend);
}

void MeshSource::fail_at_line(size_t line, const std::string& cause, const std::string& mend) const {
    throw InputError(name + ", line " + std::to_string(line) + ": " + cause + "; " + mend);
}

void MeshSource::fail_at_byte(size_t byte, const std::string& cause, const std::string& mend) const {
    throw InputError(name + ", byte " + std::to_string(byte) + ": " + cause + "; " + mend);
}

void Skipped::report(const MeshSource& source, const std::string& what, const char* unit) const {
    if (count > 0) {
        source.warn(std::to_string(count) + " " + what + " (first: " + unit + " " + std::to_string(first) +
                    ")");
    }
}

namespace {

Mesh read_format(MeshFormat format, const MeshSource& source) {
    switch (format) {
    case MeshFormat::obj:
        return read_obj(source);
    case MeshFormat::ply:
        return read_ply(source);
    case MeshFormat::stl:
        return read_stl(source);
    case MeshFormat::off:
        break;
    }
    return read_off(source);
}

/// Messages are printed: no control characters of a damaged file may reach the terminal.
void make_printable(std::string& message) {
    for (char& c : message) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            c = '?';
        }
    }
}

Mesh read_checked(const MeshSource& source, MeshFormat format) {
    if (source.text.empty()) {
        source.fail("the file is empty", "export the mesh again");
    }
    Mesh mesh = read_format(format, source);
    if (mesh.vertex_count() == 0) {
        source.fail("the file has no vertex",
                    "check that it is a mesh file of the kind that its extension says");
    }
    if (mesh.polygon_count() == 0) {
        source.fail("the file has no face with three corners", "Anvil needs a surface; export the faces too");
    }
    triangulate(mesh);
    return mesh;
}

} // namespace

Mesh read_mesh(const std::filesystem::path& path, Log& log) {
    const MeshFormat format = mesh_format(path);
    const std::string text = read_file(path);
    const MeshSource source{path.string(), text, log};
    const size_t known = log.warnings.size();
    Mesh mesh;
    try {
        mesh = read_checked(source, format);
    } catch (const InputError& error) {
        std::string message = error.what();
        make_printable(message);
        throw InputError(message);
    }
    const MeshHealth health = examine(mesh);
    if (health.degenerate_triangles.count == mesh.triangles.size()) {
        source.fail("no face has area",
                    "all corners of each face coincide or lie on a line; check the export");
    }
    Log found;
    warn_about(health, found);
    for (const std::string& warning : found.warnings) {
        source.warn(warning);
    }
    for (size_t i = known; i < log.warnings.size(); ++i) {
        make_printable(log.warnings[i]);
    }
    mesh.double_precision = mesh.double_precision || far_from_origin(health.box) ||
                            float_loss(mesh.positions) > float_loss_limit * health.diagonal;
    return mesh;
}

} // namespace anvil
