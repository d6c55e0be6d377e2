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

/// Bakes the field; its bytes.
size_t baked_bytes(const ExactDistance& solid, const Field& field, SearchDevice* device) {
    Progress unheard;
    if (field.kind == FieldKind::dense) {
        return bake(solid, field.resolution, unheard, device).texels.size() * sizeof(float);
    }
    return bake_adaptive(solid, field.resolution, unheard, device).bytes();
}

ReadyCase bake_case(size_t vertices, const Field& field, SearchDevice* device) {
    const Mesh mesh = make_sample("bust", vertices);
    const std::shared_ptr<const ExactDistance> solid = mesh_distance(mesh);
    ReadyCase ready;
    ready.vertices = mesh.vertex_count();
    ready.region = mesh.vertex_count();
    ready.bytes = baked_bytes(*solid, field, device);
    ready.work = [solid, field, device] { baked_bytes(*solid, field, device); };
    if (device != nullptr) {
        ready.yardsticks.push_back({"cpu", [solid, field] { baked_bytes(*solid, field, nullptr); }});
    } else {
        ready.yardsticks.push_back(exact_yardstick(solid));
    }
    return ready;
}

} // namespace

void add_bake_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    const size_t vertices = extent.quick ? 10'000 : 50'000;
    const auto add = [&](FieldKind kind, uint32_t resolution, SearchDevice* device) {
        const std::string name = std::string(device != nullptr ? "bake-on-device/" : "bake/") +
                                 (kind == FieldKind::dense ? "dense" : "adaptive") + "/" +
                                 std::to_string(resolution) + "/" + size_text(vertices);
        cases.push_back({name, [=] { return bake_case(vertices, {kind, resolution}, device); }});
    };
    add(FieldKind::dense, 64, nullptr);
    add(FieldKind::adaptive, 64, nullptr);
    if (!extent.quick) {
        add(FieldKind::dense, 128, nullptr);
        add(FieldKind::adaptive, 128, nullptr);
        add(FieldKind::adaptive, 256, nullptr);
    }
    if (SearchDevice* const device = workshop.tested().search_device()) {
        add(FieldKind::adaptive, extent.quick ? 64 : 128, device);
    }
}

} // namespace anvil
