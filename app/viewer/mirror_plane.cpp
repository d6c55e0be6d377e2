#include "app/viewer/mirror_plane.h"

namespace anvil {

namespace {

constexpr double margin = 1.15;
const glm::vec4 sheet_colour(0.10F, 0.42F, 0.34F, 0.16F);

Mesh unit_sheet() {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.add_polygon(std::array<uint32_t, 4>{0, 1, 2, 3});
    triangulate(mesh);
    return mesh;
}

} // namespace

std::array<Vec3, 4> MirrorPlane::Place::corners() const {
    const Vec3 a(axes[0]);
    const Vec3 b(axes[1]);
    return {origin - a - b, origin + a - b, origin + a + b, origin - a + b};
}

MirrorPlane::MirrorPlane(DeviceState& device) {
    const Mesh mesh = unit_sheet();
    sheet_ = std::make_shared<DrawnMesh>(device, mesh, mesh.positions, Vec3(0), false);
}

MirrorPlane::Place MirrorPlane::place(const Mirror& mirror, const Box& scene) {
    const Vec3 half = 0.5 * margin * (scene.high - scene.low) + Vec3(0.02 * scene.diagonal());
    Place place;
    place.origin = scene.centre();
    place.origin[mirror.axis] = mirror.origin;
    const int first = (mirror.axis + 1) % 3;
    const int second = (mirror.axis + 2) % 3;
    place.axes = glm::mat3(0);
    place.axes[0][first] = static_cast<float>(half[first]);
    place.axes[1][second] = static_cast<float>(half[second]);
    place.axes[2][mirror.axis] = 1;
    return place;
}

SceneItem MirrorPlane::item() const {
    SceneItem item;
    item.mesh = sheet_;
    item.colour = sheet_colour;
    item.tinted = false;
    item.plain_back = true;
    item.edges = true;
    return item;
}

} // namespace anvil
