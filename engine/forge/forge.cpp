#include "engine/forge/forge.h"

#include "engine/core/error.h"
#include "engine/forge/apply_edit.h"
#include "engine/forge/edit_motion.h"
#include "engine/forge/stage_timer.h"

#include <future>

namespace anvil {

namespace {

std::string place_of(size_t edit) {
    return "edits[" + std::to_string(edit) + "]";
}

/// Compiles what the edits need while the first ones' distances are measured.
std::future<void> warmed(const Recipe& recipe, const EditOccluders& occluders, const LocalFrame& frame,
                         Backend& backend) {
    std::vector<std::pair<DeformInput, DeformMotion>> likes;
    for (size_t i = 0; i < recipe.edits.size(); ++i) {
        Edit edit = recipe.edits[i];
        if (edit.mirror) { // as many handles as most likely will be
            const std::vector<Handle> given = edit.handles;
            edit.handles.insert(edit.handles.end(), given.begin(), given.end());
        }
        DeformInput like;
        like.handle_count = edit.handles.size();
        const OccluderScale scale{frame.origin, frame.diagonal, edit.radius.value_or(frame.diagonal)};
        like.occluders = occluders.set_for(edit, scale, place_of(i));
        set_shapes(shapes_of(edit), like);
        DeformMotion motion = foreseen_motion(edit, like.occluders);
        likes.emplace_back(std::move(like), std::move(motion));
    }
    return std::async(std::launch::async, [&backend, likes = std::move(likes)] {
        for (const auto& [input, motion] : likes) {
            backend.warm(input, motion);
        }
    });
}

/// The surface after all edits; notes in the report what each did.
SurfaceVersion after_edits(SurfaceVersion version, const Recipe& recipe, Backend& backend, Log& log,
                           Progress& progress, const FileCache* cache, ForgeReport& report) {
    std::optional<EditOccluders> occluders;
    {
        const StageTimer timer(report.seconds.bake);
        occluders.emplace(recipe, log, progress, cache, nullptr, backend.search_device());
    }
    const std::future<void> warming = warmed(recipe, *occluders, version.frame, backend);
    KeptSolvers solvers;
    const EditTools tools{*occluders, solvers, backend, log, progress};
    for (size_t i = 0; i < recipe.edits.size(); ++i) {
        progress.report("forge", static_cast<double>(i) / static_cast<double>(recipe.edits.size()));
        version = apply_edit(std::move(version), recipe.edits[i], place_of(i), tools);
        report.seconds += version.seconds;
        report.edits.push_back(std::move(version.report));
    }
    return version;
}

} // namespace

ForgeResult forge(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log, Progress& progress,
                  const FileCache* cache) {
    ForgeResult result;
    SurfaceVersion version = first_version({std::shared_ptr<void>(), &mesh}); // not ours: outlives the call
    try {
        version = after_edits(std::move(version), recipe, backend, log, progress, cache, result.report);
    } catch (const InputError& error) {
        throw InputError(recipe.file + ": " + error.what());
    }
    progress.report("forge", 1);
    result.report.device = backend.device_name(); // by now: it may have changed to another one
    result.report.driver = backend.driver_name();
    result.report.vertices = version.mesh->vertex_count();
    result.report.faces = version.mesh->polygon_count();
    result.report.warnings = log.warnings;
    result.positions = std::move(version.positions);
    result.moved = std::move(version.moved);
    result.weights = std::move(version.weights);
    result.touching = std::move(version.touching);
    result.parents = version.history->parents();
    result.refined = version.refined() ? std::move(version.mesh) : nullptr;
    return result;
}

} // namespace anvil
