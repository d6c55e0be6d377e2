#include "app/viewer/panels/occluder_panel.h"

#include <filesystem>

namespace anvil {

namespace {

std::string free_name(const Recipe& recipe, const std::string& base) {
    std::string name = base;
    for (int i = 2; find_occluder(recipe, name) != nullptr; ++i) {
        name = base + " " + std::to_string(i);
    }
    return name;
}

} // namespace

OccluderShape occluder_shape(const std::string& kind, double size) {
    if (kind == "sphere") {
        return {SphereShape{size}};
    }
    if (kind == "box") {
        return {BoxShape{Vec3(size), 0.1 * size}};
    }
    if (kind == "cylinder") {
        return {CylinderShape{size, 2 * size}};
    }
    if (kind == "capsule") {
        return {CapsuleShape{0.6 * size, 2 * size}};
    }
    if (kind == "cone") {
        return {ConeShape{size, 2 * size}};
    }
    if (kind == "torus") {
        return {TorusShape{size, 0.3 * size}};
    }
    if (kind == "plane") {
        return {PlaneShape{Vec3(0, 1, 0), 0}};
    }
    const std::string file = std::filesystem::absolute(kind).string();
    return std::filesystem::path(kind).extension() == ".vdb" ? OccluderShape{VdbShape{file, ""}}
                                                             : OccluderShape{MeshShape{file}};
}

std::vector<std::string> occluder_kinds() {
    return {"sphere", "box", "cylinder", "capsule", "cone", "torus", "plane"};
}

Occluder new_occluder(const Recipe& recipe, const std::string& kind, const Box& scene) {
    const double size = 0.1 * scene.diagonal();
    Occluder occluder;
    occluder.name = free_name(recipe, std::filesystem::path(kind).stem().string());
    occluder.shape = occluder_shape(kind, size);
    const bool is_plane = kind == "plane";
    // Beside the mesh, where nothing starts inside it; a plane below.
    occluder.transform.translate = is_plane
                                       ? Vec3(scene.centre().x, scene.low.y, scene.centre().z)
                                       : Vec3(scene.high.x + 1.5 * size, scene.centre().y, scene.centre().z);
    return occluder;
}

} // namespace anvil
