#include "engine/mesh/mesh_format.h"

#include "engine/core/error.h"

namespace anvil {

MeshFormat mesh_format(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (extension == ".obj") {
        return MeshFormat::obj;
    }
    if (extension == ".ply") {
        return MeshFormat::ply;
    }
    if (extension == ".stl") {
        return MeshFormat::stl;
    }
    if (extension == ".off") {
        return MeshFormat::off;
    }
    throw InputError(path.string() + ": " +
                     (extension.empty() ? "no extension" : "unknown extension " + extension) +
                     "; mesh files end with .obj, .ply, .stl or .off");
}

} // namespace anvil
