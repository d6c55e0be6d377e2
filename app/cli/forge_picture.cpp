#include "app/cli/forge_picture.h"

#include "engine/gpu/offscreen_renderer.h"
#include "engine/occluder/occluder_motion.h"
#include "engine/occluder/shown_surface.h"

#include <algorithm>
#include <list>
#include <set>

namespace anvil {

namespace {

constexpr int occluder_cells = 96;
const glm::vec3 contact_colour(0.72F, 0.16F, 0.2F);

struct DrawnSurface {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
};

std::vector<glm::vec3> relative(std::span<const Vec3> positions, const Vec3& origin) {
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const Vec3& p : positions) {
        result.emplace_back(p - origin);
    }
    return result;
}

DrawnSurface occluder_surface(const Occluder& occluder, const Placement& place, const Box& scene,
                              const std::filesystem::path& folder) {
    Mesh mesh = shown_surface(occluder.shape, place, scene, {folder, nullptr}, occluder_cells);
    for (Vec3& p : mesh.positions) {
        p = place.origin + place.scale * (place.axes[0] * p.x + place.axes[1] * p.y + place.axes[2] * p.z);
    }
    return {relative(mesh.positions, scene.centre()), mesh.triangles};
}

/// Colours and weights of the surface, contact in a colour of its own; empty where nothing touches.
struct ContactColours {
    ContactColours(const ForgeResult& result, const glm::vec3& base) {
        if (std::find(result.touching.begin(), result.touching.end(), true) == result.touching.end()) {
            return;
        }
        colours.assign(result.touching.size(), base);
        weights = result.weights;
        for (size_t v = 0; v < result.touching.size(); ++v) {
            if (result.touching[v]) {
                colours[v] = contact_colour;
                weights[v] = 0; // no region's tint over it
            }
        }
    }

    std::vector<glm::vec3> colours;
    std::vector<float> weights;
};

struct DrawnOccluder {
    std::string name;
    Placement place;
};

/// The occluders as the last edit that uses any leaves them.
std::vector<DrawnOccluder> drawn_occluders(const Recipe& recipe) {
    std::vector<DrawnOccluder> drawn;
    for (size_t i = recipe.edits.size(); drawn.empty() && i-- > 0;) {
        const Edit& edit = recipe.edits[i];
        for (const OccluderUse& use : occluders_of(recipe, edit)) {
            const auto poses = timed_poses(use);
            drawn.push_back(
                {use.name, poses.empty() ? placement(*use.transform) : pose_at(poses, edit.amount)});
        }
    }
    return drawn;
}

Box box_of(std::span<const Vec3> positions) {
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    return box;
}

} // namespace

Picture forge_picture(Device& device, const Mesh& mesh, const Recipe& recipe, const ForgeResult& result,
                      const PictureView& view, PictureSize size, Progress& progress) {
    progress.report("picture", 0);
    const Box scene = box_of(result.positions);
    std::list<DrawnSurface> occluders;
    for (const DrawnOccluder& drawn : drawn_occluders(recipe)) {
        occluders.push_back(
            occluder_surface(*find_occluder(recipe, drawn.name), drawn.place, scene, recipe_folder(recipe)));
    }
    const auto positions = relative(result.positions, scene.centre());
    std::vector<PictureSurface> surfaces{{positions, mesh.triangles, result.weights}};
    const ContactColours contact(result, surfaces[0].base_colour);
    if (!contact.colours.empty()) {
        surfaces[0].colours = contact.colours;
        surfaces[0].tint = contact.weights;
    }
    for (const DrawnSurface& occluder : occluders) {
        PictureSurface surface{occluder.positions, occluder.triangles};
        surface.base_colour = glm::vec3(0.45F, 0.62F, 0.75F);
        surface.opacity = 0.45F;
        surfaces.push_back(surface);
    }
    progress.report("picture", 0.5);
    OffscreenRenderer renderer(device);
    Picture picture = renderer.render(surfaces, view, size);
    progress.report("picture", 1);
    return picture;
}

} // namespace anvil
