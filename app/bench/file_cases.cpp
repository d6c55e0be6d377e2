// Meshes from and to files.
#include "app/bench/workshop.h"
#include "engine/core/scratch_folder.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"

namespace anvil {

namespace {

/// A binary PLY file of the workshop's sphere.
struct FileScene {
    ScratchFolder folder;
    std::shared_ptr<const Mesh> mesh;
    std::filesystem::path path = folder / "sphere.ply";

    explicit FileScene(std::shared_ptr<const Mesh> of) : mesh(std::move(of)) {
        write_mesh(path, *mesh, mesh->positions);
    }

    ReadyCase ready() const {
        ReadyCase ready;
        ready.vertices = mesh->vertex_count();
        ready.region = mesh->vertex_count();
        ready.bytes = std::filesystem::file_size(path);
        ready.yardsticks.push_back(memcpy_yardstick(ready.bytes));
        return ready;
    }
};

ReadyCase load_case(const std::shared_ptr<const Mesh>& mesh) {
    const auto scene = std::make_shared<FileScene>(mesh);
    ReadyCase ready = scene->ready();
    ready.work = [scene] {
        Log log;
        read_mesh(scene->path, log);
    };
    return ready;
}

ReadyCase save_case(const std::shared_ptr<const Mesh>& mesh) {
    const auto scene = std::make_shared<FileScene>(mesh);
    ReadyCase ready = scene->ready();
    ready.work = [scene] { write_mesh(scene->folder / "saved.ply", *scene->mesh, scene->mesh->positions); };
    return ready;
}

} // namespace

void add_file_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    for (const size_t vertices : extent.sizes()) {
        cases.push_back({"load/ply/" + size_text(vertices),
                         [&workshop, vertices] { return load_case(workshop.sphere(vertices)); }});
        cases.push_back({"save/ply/" + size_text(vertices),
                         [&workshop, vertices] { return save_case(workshop.sphere(vertices)); }});
    }
}

} // namespace anvil
