#include "app/bench/deform_scene.h"

#include "engine/forge/region_fans.h"
#include "engine/mesh/place_order.h"

#include <algorithm>
#include <numbers>
#include <random>

namespace anvil {

namespace {

const Vec3 pole{0, 1, 0};

/// The first at the pole, the others down a spiral.
Vec3 handle_place(size_t j) {
    const double y = 1 - 0.05 * static_cast<double>(j);
    const double angle = static_cast<double>(j) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - y * y);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

std::vector<Vec3> places_of(const Mesh& mesh, const std::vector<uint32_t>& vertices) {
    std::vector<Vec3> places;
    places.reserve(vertices.size());
    std::transform(vertices.begin(), vertices.end(), std::back_inserter(places),
                   [&](uint32_t v) { return mesh.positions[v]; });
    return places;
}

/// Vertices within a distance of the pole.
std::vector<uint32_t> vertices_within(const Mesh& sphere, double radius, PointOrder order) {
    std::vector<uint32_t> given;
    for (uint32_t v = 0; v < sphere.vertex_count(); ++v) {
        if (glm::length(sphere.positions[v] - pole) <= radius) {
            given.push_back(v);
        }
    }
    if (order == PointOrder::shuffled) {
        std::shuffle(given.begin(), given.end(), std::mt19937_64(1));
    }
    if (order != PointOrder::by_place) {
        return given;
    }
    std::vector<uint32_t> vertices;
    vertices.reserve(given.size());
    for (const uint32_t i : order_by_place(places_of(sphere, given))) {
        vertices.push_back(given[i]);
    }
    return vertices;
}

/// One smooth falloff for each handle, straight distances.
void add_handles(DeformInput& input, size_t count, double radius) {
    const ShapeFunction shape;
    input.handle_count = count;
    input.fields.reserve(count * input.points.size());
    for (size_t j = 0; j < count; ++j) {
        const Vec3 handle = handle_place(j);
        std::transform(input.points.begin(), input.points.end(), std::back_inserter(input.fields),
                       [&](const Vec3& p) { return glm::length(p - handle) / radius; });
        input.shapes.push_back(
            {static_cast<uint32_t>(input.segments.size()), static_cast<uint32_t>(shape.segments().size())});
        for (const auto& s : shape.segments()) {
            input.segments.push_back({s.begin, s.c0, s.c1, s.c2, s.c3});
        }
    }
}

/// Half a radius up, or a swing about an axis below the sphere that carries the pole outward.
DeformMotion motion_of(const DeformSceneOptions& options, double radius) {
    DeformMotion motion;
    motion.kind = options.kind;
    motion.path_epsilon = 1e-9;
    const double part = 1 / static_cast<double>(options.handles);
    if (options.kind == MotionKind::straight) {
        motion.targets.assign(options.handles, part * Vec3(0, 0.5 * radius, 0));
    } else {
        motion.axis_origin = -pole;
        motion.axis_direction = {0, 0, 1};
        motion.targets.assign(options.handles, part * Vec3(0.6, 0, 0));
    }
    if (options.fixed_steps > 0) {
        motion.fixed_steps = true;
        motion.steps = options.fixed_steps;
    }
    return motion;
}

/// In the way of the pole, clear of the sphere.
void add_obstacle(DeformInput& input, const DeformSceneOptions& options, double radius) {
    Transform pose;
    pose.scale = 0.4 * radius;
    pose.translate =
        options.kind == MotionKind::straight ? Vec3(0.15 * radius, 1 + 0.6 * radius, 0) : Vec3(-1.2, 1.35, 0);
    const OccluderScale scale{Vec3(0), 2 * std::sqrt(3.0), radius};
    add_occluder(input.occluders, *options.occluder, "obstacle", pose, {}, scale);
    find_start_distances(input);
}

/// Places and fans read, normals and places written.
uint64_t normals_bytes(const DeformInput& input) {
    const NormalFans& fans = input.fans;
    return fans.empty() ? 0
                        : fans.normal_count() * (sizeof(uint32_t) + sizeof(glm::vec3)) +
                              fans.corners.size() * sizeof(kernel::f64::FanCorner) +
                              2 * input.points.size() * sizeof(glm::vec3);
}

} // namespace

DeformScene make_deform_scene(const Mesh& sphere, const DeformSceneOptions& options) {
    const double radius = 2 * std::sqrt(options.share); // a cap's area is pi times its chord squared
    DeformScene scene;
    scene.input = std::make_shared<DeformInput>();
    const std::vector<uint32_t> vertices = vertices_within(sphere, radius, options.order);
    scene.input->points = places_of(sphere, vertices);
    add_handles(*scene.input, options.handles, radius);
    scene.motion = motion_of(options, radius);
    if (options.occluder != nullptr) {
        add_obstacle(*scene.input, options, radius);
    }
    if (options.normals) {
        VertexNumbers numbers(sphere.vertex_count());
        const Incidence incidence = incident_triangles(sphere.triangles, sphere.vertex_count());
        scene.input->fans = fans_around(vertices, sphere, incidence, sphere.positions, Vec3(0), numbers).fans;
    }
    return scene;
}

uint64_t state_bytes(const DeformScene& scene) {
    const bool past_occluders = !scene.input->occluders.empty();
    const bool by_place = past_occluders || scene.motion.kind != MotionKind::straight;
    const uint64_t counts = 3 * sizeof(uint32_t);
    const uint64_t of_point = (by_place ? sizeof(glm::vec3) : 0) +
                              (past_occluders ? sizeof(float) + counts : 0) +
                              scene.input->handle_count * sizeof(float) + sizeof(glm::vec3);
    return of_point * scene.input->points.size() + normals_bytes(*scene.input);
}

} // namespace anvil
