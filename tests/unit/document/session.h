// A document on a mesh in a folder of its own, with all that its calls need.
#pragma once

#include "engine/core/scratch_folder.h"
#include "engine/document/document.h"
#include "engine/forge/drag_scene.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

namespace anvil::test {

/// An edit that pulls the surface near a place outwards, within 0.5.
inline Edit pull(const Vec3& place, double by) {
    Edit edit;
    Handle handle;
    handle.at = NearestAddress{place};
    handle.by = by * place;
    edit.handles.push_back(handle);
    edit.radius = 0.5;
    return edit;
}

struct Session {
    explicit Session(size_t vertices = 642) {
        write_mesh(mesh, make_sample("icosphere", vertices), make_sample("icosphere", vertices).positions);
    }

    std::unique_ptr<Document> open() { return Document::open(mesh, work, options); }

    /// Steps that use what there is: edits, occluders, refinement, past edits changed and taken away.
    std::vector<Recipe> story(Recipe recipe) const {
        std::vector<Recipe> steps;
        const auto step = [&] { steps.push_back(recipe); };
        recipe.edits.push_back(pull(Vec3(1, 0, 0), 0.1));
        step();
        recipe.occluders.push_back({"ball", {SphereShape{0.3}}, {}, {Vec3(0, 1.35, 0)}, {}});
        step();
        recipe.edits.push_back(with_poses(recipe, pull(Vec3(0, 1, 0), 0.2)));
        step();
        recipe.edits.push_back(pull(Vec3(0.6, 0.8, 0), 0.2));
        recipe.edits.back().occluders = std::vector<OccluderUse>{};
        recipe.edits.back().refine = Refine{};
        recipe.edits.back().refine->shape_tolerance = 0.02;
        step();
        recipe.edits.push_back(pull(Vec3(0.5, 0.5, 0.5), -0.1));
        recipe.edits.back().smooth_surface = 2;
        step();
        recipe.edits[0].amount = 0.5;
        step();
        recipe.edits.erase(recipe.edits.begin() + 1);
        step();
        recipe.occluders[0].transform.translate = Vec3(0, 1.3, 0.3);
        step();
        return steps;
    }

    ScratchFolder folder;
    std::filesystem::path mesh = folder / "sphere.ply";
    std::unique_ptr<Backend> backend = make_cpu_backend();
    Log log;
    Progress progress;
    EditWork work{*backend, log, progress};
    DocumentOptions options;
};

/// What the document shows is forge's result for its recipe.
inline void check_as_forged(const Document& document, Session& session, Backend& backend) {
    const ForgeResult forged = anvil::test::forged(*document.mesh(), document.recipe(), backend, session.log);
    const SurfaceVersion& surface = *document.surface();
    CHECK(surface.positions == forged.positions);
    CHECK(surface.moved == forged.moved);
    CHECK(surface.weights == forged.weights);
    CHECK(surface.touching == forged.touching);
    CHECK(surface.refined() == (forged.refined != nullptr));
    CHECK((!forged.refined || surface.mesh->triangles == forged.refined->triangles));
}
inline void check_as_forged(const Document& document, Session& session) {
    check_as_forged(document, session, *session.backend);
}

/// Differs where a bit differs (FNV-1a).
inline uint64_t checksum(const std::vector<Vec3>& positions) {
    uint64_t sum = 0xcbf29ce484222325ULL;
    for (const Vec3& p : positions) {
        for (int i = 0; i < 3; ++i) {
            uint64_t bits = 0;
            const double value = p[i];
            std::memcpy(&bits, &value, sizeof bits);
            sum = (sum ^ bits) * 0x100000001b3ULL;
        }
    }
    return sum;
}

} // namespace anvil::test
