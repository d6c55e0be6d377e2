#include "app/cli/distance_picture.h"

#include "engine/mesh/sample_shapes.h"

#include <cmath>

namespace anvil {

namespace {

const glm::vec3 unreached_colour{0.78F, 0.78F, 0.78F};
const glm::vec3 source_colour{0.62F, 0.05F, 0.12F};
constexpr double source_size = 0.006; // radius of a ball over the mesh's diagonal

bool is_reached(const Triangle& t, const std::vector<double>& distances) {
    return std::isfinite(distances[t[0]]) && std::isfinite(distances[t[1]]) && std::isfinite(distances[t[2]]);
}

/// A ball at each source, all in one mesh.
Mesh balls(const std::vector<Vec3>& centres, double radius) {
    const Mesh ball = make_sample("icosphere", 160);
    Mesh mesh;
    for (const Vec3& centre : centres) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3& p : ball.positions) {
            mesh.positions.push_back(centre + radius * p);
        }
        for (const Triangle& t : ball.triangles) {
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
    }
    return mesh;
}

std::vector<glm::vec3> relative(const std::vector<Vec3>& positions, const Vec3& origin) {
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const Vec3& p : positions) {
        result.emplace_back(p - origin);
    }
    return result;
}

} // namespace

double isoline_spacing(double farthest) {
    constexpr double most_lines = 30;
    const double power = std::pow(10.0, std::floor(std::log10(farthest / most_lines)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * power * most_lines >= farthest) {
            return digit * power;
        }
    }
    return 10 * power;
}

double farthest_of(const std::vector<double>& distances) {
    double farthest = 0;
    for (const double distance : distances) {
        farthest = std::isfinite(distance) ? std::max(farthest, distance) : farthest;
    }
    return farthest;
}

void draw_distances(Device& device, const Mesh& mesh, const std::vector<double>& distances,
                    const std::vector<Vec3>& sources, const PictureOptions& options) {
    const Box box = bounds(mesh);
    const double farthest = farthest_of(distances);
    std::vector<Triangle> reached, unreached;
    for (const Triangle& t : mesh.triangles) {
        (is_reached(t, distances) ? reached : unreached).push_back(t);
    }
    const auto positions = relative(mesh.positions, box.centre());
    const std::vector<float> lengths(distances.begin(), distances.end());
    const Mesh marks = balls(sources, source_size * box.diagonal());
    const auto mark_positions = relative(marks.positions, box.centre());

    std::vector<PictureSurface> surfaces(3);
    surfaces[0].positions = positions;
    surfaces[0].triangles = reached;
    if (farthest > 0) {
        surfaces[0].tint = lengths;
        surfaces[0].contour_spacing = static_cast<float>(isoline_spacing(farthest));
        surfaces[0].contour_end = static_cast<float>(farthest);
    }
    surfaces[1].positions = positions;
    surfaces[1].triangles = unreached;
    surfaces[1].base_colour = unreached_colour;
    surfaces[2].positions = mark_positions;
    surfaces[2].triangles = marks.triangles;
    surfaces[2].base_colour = source_colour;
    write_picture(device, surfaces, options);
}

} // namespace anvil
