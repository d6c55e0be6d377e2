// Distance fields of a mesh, beside exact distances one by one.
#include "app/bench/workshop.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/adaptive_field.h"
#include "engine/occluder/mesh_distance.h"

namespace anvil {

namespace {

constexpr size_t exact_points = 32; // along each axis

/// Exact distances on a coarse grid over the solid's box, on all cores.
Yardstick exact_yardstick(const std::shared_ptr<const ExactDistance>& solid) {
    return {"exact_points", [solid] {
                const Box box = solid->bounds();
                parallel_for(exact_points * exact_points, 1, [&](size_t begin, size_t end) {
                    for (size_t row = begin; row < end; ++row) {
                        for (size_t x = 0; x < exact_points; ++x) {
                            const Vec3 share = (Vec3(x, row % exact_points, row / exact_points) + 0.5) /
                                               static_cast<double>(exact_points);
                            solid->at(box.low + share * (box.high - box.low));
                        }
                    }
                });
            }};
}

ReadyCase bake_case(size_t vertices, FieldKind kind, uint32_t resolution) {
    const Mesh mesh = make_sample("bust", vertices);
    const std::shared_ptr<const ExactDistance> solid = mesh_distance(mesh);
    ReadyCase ready;
    ready.vertices = mesh.vertex_count();
    ready.region = mesh.vertex_count();
    Progress once;
    if (kind == FieldKind::dense) {
        ready.bytes = bake(*solid, resolution, once).texels.size() * sizeof(float);
    } else {
        ready.bytes = bake_adaptive(*solid, resolution, once).bytes();
    }
    ready.work = [solid, kind, resolution] {
        Progress unheard;
        if (kind == FieldKind::dense) {
            bake(*solid, resolution, unheard);
        } else {
            bake_adaptive(*solid, resolution, unheard);
        }
    };
    ready.yardsticks.push_back(exact_yardstick(solid));
    return ready;
}

} // namespace

void add_bake_cases(std::vector<BenchCase>& cases, Workshop&, const BenchExtent& extent) {
    const size_t vertices = extent.quick ? 10'000 : 50'000;
    const auto add = [&](FieldKind kind, uint32_t resolution) {
        const std::string name = std::string("bake/") + (kind == FieldKind::dense ? "dense" : "adaptive") +
                                 "/" + std::to_string(resolution);
        cases.push_back(
            {name + "/" + size_text(vertices), [=] { return bake_case(vertices, kind, resolution); }});
    };
    add(FieldKind::dense, 64);
    add(FieldKind::adaptive, 64);
    if (!extent.quick) {
        add(FieldKind::dense, 128);
        add(FieldKind::adaptive, 128);
        add(FieldKind::adaptive, 256);
    }
}

} // namespace anvil
