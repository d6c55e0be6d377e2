#include "app/cli/distance_picture.h"

#include <cmath>

namespace anvil {

namespace {

const glm::vec3 near_colour{0.95F, 0.55F, 0.15F};
const glm::vec3 far_colour{0.20F, 0.35F, 0.80F};
const glm::vec3 unreached_colour{0.75F, 0.75F, 0.75F};

glm::vec3 colour_of(double distance, double largest) {
    if (!std::isfinite(distance)) {
        return unreached_colour;
    }
    constexpr double bands = 12;
    const double t = largest > 0 ? distance / largest : 0;
    const double phase = t * bands - std::floor(t * bands);
    const float shade = phase < 0.15 && t > 0 ? 0.6F : 1.0F;
    return shade * glm::mix(near_colour, far_colour, static_cast<float>(t));
}

} // namespace

void draw_distances(Device& device, const Mesh& mesh, const std::vector<double>& distances,
                    const PictureOptions& options) {
    double largest = 0;
    for (const double distance : distances) {
        if (std::isfinite(distance)) {
            largest = std::max(largest, distance);
        }
    }
    const Vec3 origin = bounds(mesh).centre();
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> colours;
    positions.reserve(mesh.vertex_count());
    colours.reserve(mesh.vertex_count());
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        positions.emplace_back(mesh.positions[v] - origin);
        colours.push_back(colour_of(distances[v], largest));
    }
    PictureSurface surface;
    surface.positions = positions;
    surface.triangles = mesh.triangles;
    surface.colours = colours;
    write_picture(device, std::span(&surface, 1), options);
}

} // namespace anvil
