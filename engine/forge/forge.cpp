#include "engine/forge/forge.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/forge/contact_lists.h"
#include "engine/forge/dilation.h"
#include "engine/forge/edit_input.h"
#include "engine/forge/edit_motion.h"
#include "engine/forge/edit_occluders.h"
#include "engine/forge/edit_region.h"
#include "engine/forge/refine_edit.h"
#include "engine/forge/surface_state.h"
#include "engine/forge/trial_run.h"
#include "engine/forge/volume.h"
#include "engine/refine/point_vertices.h"
#include "engine/refine/space_criterion.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>

namespace anvil {

namespace {

constexpr double tolerated_volume_error = 1e-3;

/// Adds the time that it lives to a stage.
class StageTimer {
  public:
    explicit StageTimer(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
    ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
};

class Forger {
  public:
    Forger(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log, Progress& progress,
           const FileCache* cache)
        : file_(mesh), history_(mesh), recipe_(recipe), backend_(backend), log_(log), progress_(progress),
          cache_(cache) {
        result_.positions = file_.positions;
        result_.moved.assign(mesh.vertex_count(), false);
        result_.weights.assign(mesh.vertex_count(), 0.0F);
        const LocalFrame frame = local_frame(mesh);
        origin_ = frame.origin;
        diagonal_ = frame.diagonal;
    }

    ForgeResult run() {
        result_.report.device = backend_.device_name();
        result_.report.driver = backend_.driver_name();
        if (is_closed(mesh())) {
            volume_ = enclosed_volume(mesh(), result_.positions);
        }
        try {
            build_occluders();
            const std::future<void> warming = warmed();
            for (size_t i = 0; i < recipe_.edits.size(); ++i) {
                progress_.report("forge", static_cast<double>(i) / static_cast<double>(recipe_.edits.size()));
                apply(recipe_.edits[i], "edits[" + std::to_string(i) + "]");
            }
        } catch (const InputError& error) {
            throw InputError(recipe_.file + ": " + error.what());
        }
        progress_.report("forge", 1);
        result_.touching.resize(mesh().vertex_count(), false); // what a later edit added touches nothing
        result_.report.vertices = mesh().vertex_count();
        result_.report.faces = mesh().polygon_count();
        result_.parents = history_.parents();
        result_.report.warnings = log_.warnings;
        return std::move(result_);
    }

  private:
    /// The mesh as refinement has left it, before any edit.
    const Mesh& mesh() const { return result_.refined ? *result_.refined : file_; }

    StageSeconds& seconds() { return result_.report.seconds; }

    void build_occluders() {
        const StageTimer timer(seconds().bake);
        occluders_.emplace(recipe_, log_, progress_, cache_);
    }

    /// Compiles what the edits need while the first ones' distances are measured.
    std::future<void> warmed() {
        std::vector<std::pair<DeformInput, DeformMotion>> likes;
        for (size_t i = 0; i < recipe_.edits.size(); ++i) {
            const Edit& edit = recipe_.edits[i];
            DeformInput like;
            like.handle_count = edit.handles.size();
            like.occluders = occluders_->set_for(edit, {origin_, diagonal_, edit.radius.value_or(diagonal_)},
                                                 "edits[" + std::to_string(i) + "]");
            set_shapes(shapes_of(edit), like);
            DeformMotion motion = foreseen_motion(edit, like.occluders);
            likes.emplace_back(std::move(like), std::move(motion));
        }
        return std::async(std::launch::async, [this, likes = std::move(likes)] {
            for (const auto& [input, motion] : likes) {
                backend_.warm(input, motion);
            }
        });
    }

    void apply(const Edit& edit, const std::string& place) {
        EditReport report;
        report.kind = edit.kind == EditKind::translate ? "translate" : "rotate";
        const size_t points_added = edit.refine ? make_points_vertices(edit, place) : 0;
        const EditRegion region =
            edit.refine ? refine_region(edit, place, points_added, report) : measure_region(edit, place);
        report.radii = region.radii;
        report.region = region.vertices.size();
        report.distance_methods = region.methods;

        DeformInput input = prepare_input(edit, region, place);
        const EditMotion motion = solve(edit, region, input, place, report);
        std::optional<double> free_volume;
        const auto results = edit.dilation && !input.occluders.empty()
                                 ? dilated(edit, region, input, motion.motion, place, report, free_volume)
                                 : deform(input, motion.motion);
        move_vertices(edit, region, input, results, report);
        report_volume(report, free_volume);
        note_region(region, input);
        result_.report.edits.push_back(std::move(report));
    }

    size_t make_points_vertices(const Edit& edit, const std::string& place) {
        const StageTimer timer(seconds().refine);
        const std::vector<SurfacePoint> points = points_of(edit, place, surface());
        if (std::all_of(points.begin(), points.end(), is_vertex)) {
            return 0;
        }
        PointVertices made = make_vertices(mesh(), points);
        const size_t added = made.refined.parents.size();
        adopt(std::move(made.refined));
        return added;
    }

    EditRegion refine_region(const Edit& edit, const std::string& place, size_t points_added,
                             EditReport& report) {
        RefineStart start = measure_start(edit, place);
        EditRegion& region = start.region;
        const StageTimer timer(seconds().refine);
        const std::vector<uint32_t> pinned = pinned_vertices(edit, place, surface());
        const double angle_before = least_angle(mesh().triangles, result_.positions, region.vertices);
        const auto criterion = criterion_of(edit, start, place);
        Refinement refinement = refine(mesh().triangles, std::move(start.state), *criterion,
                                       options_of(*edit.refine, mesh().vertex_count()), progress_);
        if (refinement.report.added > 0) {
            adopt(divided(mesh(), std::move(refinement.state.parents), refinement.faces));
            fill_region(region, refinement.state, pinned);
        }
        report.refine = summary_of(refinement.report, points_added, place, log_);
        report.refine->min_angle_before = angle_before;
        report.refine->min_angle_after = least_angle(mesh().triangles, result_.positions, region.vertices);
        return std::move(region);
    }

    RefineStart measure_start(const Edit& edit, const std::string& place) {
        const StageTimer timer(seconds().distance);
        return start_refinement(edit, place, mesh(), result_.positions, surface());
    }

    /// Criteria in space run the whole edit, which the points added so far do not change.
    std::unique_ptr<EdgeCriterion> criterion_of(const Edit& edit, const RefineStart& start,
                                                const std::string& place) {
        const EditRegion& region = start.region;
        const Refine& settings = *edit.refine;
        if (settings.criterion == RefineCriterion::shape) {
            return make_shape_criterion();
        }
        DeformInput input = prepare_input(edit, region, place);
        Log unheard; // the edit itself says it again
        const DeformMotion motion =
            find_motion(edit, region, result_.positions, origin_, place, input.occluders, unheard).motion;
        std::vector<double> radii;
        for (const HandleField& handle : start.state.handles) {
            radii.push_back(handle.radius);
        }
        MovePoints move = [run = TrialRun(backend_, std::move(input), motion, std::move(radii), origin_)](
                              std::span<const Vec3> places, const std::vector<double>& distances) mutable {
            return run.moved(places, distances);
        };
        return settings.criterion == RefineCriterion::space
                   ? make_space_criterion(std::move(move), settings.space_tolerance)
                   : make_both_criteria(settings.shape_tolerance, std::move(move), settings.space_tolerance);
    }

    /// The mesh from here on.
    void adopt(RefinedMesh refined) {
        for (const VertexParents& p : refined.parents) {
            result_.positions.push_back(between(result_.positions[p.a], result_.positions[p.b], p.place));
            result_.moved.push_back(result_.moved[p.a] || result_.moved[p.b]);
            result_.weights.push_back(
                between(result_.weights[p.a], result_.weights[p.b], static_cast<float>(p.place)));
        }
        history_.add(refined);
        solvers_.divided(refined.roots);
        result_.refined = std::move(refined.mesh);
        surface_.reset(); // it knows the mesh before
    }

    SurfaceState& surface() {
        if (!surface_) {
            surface_.emplace(mesh(), result_.positions, history_, solvers_);
        }
        return *surface_;
    }

    EditRegion measure_region(const Edit& edit, const std::string& place) {
        const StageTimer timer(seconds().distance);
        return find_region(edit, place, surface());
    }

    DeformInput prepare_input(const Edit& edit, const EditRegion& region, const std::string& place) {
        const StageTimer timer(seconds().solve);
        return deform_input(
            region, result_.positions, origin_,
            occluders_->set_for(edit, {origin_, diagonal_, largest_radius(region, diagonal_)}, place));
    }

    EditMotion solve(const Edit& edit, const EditRegion& region, const DeformInput& input,
                     const std::string& place, EditReport& report) {
        const StageTimer timer(seconds().solve);
        EditMotion motion =
            find_motion(edit, region, result_.positions, origin_, place, input.occluders, log_);
        report.rank = motion.solution.rank;
        report.condition = motion.solution.condition;
        report.amplification = motion.solution.amplification;
        report.target_errors = motion.target_errors;
        return motion;
    }

    std::vector<PointResult> deform(const DeformInput& input, const DeformMotion& motion) {
        std::unique_ptr<DeformSession> session;
        {
            const StageTimer timer(seconds().upload);
            session = backend_.prepare(input);
        }
        {
            const StageTimer timer(seconds().deform);
            session->update(motion);
            session->wait();
        }
        const StageTimer timer(seconds().download);
        return session->download();
    }

    std::vector<PointResult> dilated(const Edit& edit, const EditRegion& region, const DeformInput& input,
                                     const DeformMotion& motion, const std::string& place, EditReport& report,
                                     std::optional<double>& free_volume) {
        const StageTimer timer(seconds().deform);
        const double width = edit.dilation->width.value_or(0.5 * largest_radius(region, diagonal_));
        try {
            DilationResult result = dilate({mesh(), result_.positions, origin_, region, input, motion,
                                            *edit.dilation, width, volume_.has_value()},
                                           surface());
            report.dilation = DilationReport{width, result.height, edit.dilation->solve};
            free_volume = result.free_volume;
            return std::move(result.points);
        } catch (const InputError& error) {
            throw InputError(place + "." + error.what());
        }
    }

    void move_vertices(const Edit& edit, const EditRegion& region, const DeformInput& input,
                       const std::vector<PointResult>& results, EditReport& report) {
        const StageTimer timer(seconds().deform);
        const EditEnds ends = finished_ends(input, results);
        for (size_t i = 0; i < ends.ends.size(); ++i) {
            const uint32_t v = region.vertices[i];
            const Vec3 end = result_.positions[v] + ends.displacements[i];
            report.moved += end != result_.positions[v] ? 1 : 0;
            result_.moved[v] = result_.moved[v] || end != result_.positions[v];
            result_.positions[v] = end;
        }
        if (report.moved > 0) {
            surface_.reset(); // it knows the positions before
            solvers_.moved();
        }
        count_steps(results, report);
        if (!input.occluders.empty()) {
            report_contact(edit, region, input, ends, report);
        }
    }

    void report_contact(const Edit& edit, const EditRegion& region, const DeformInput& input,
                        const EditEnds& ends, EditReport& report) {
        std::vector<std::string> names;
        for (const OccluderUse& use : occluders_->uses_of(edit)) {
            names.push_back(use.name);
        }
        report.contact = contact_of(input, ends, region, mesh(), result_.positions, origin_);
        report.contacts = contact_lists(*report.contact, names, region, mesh());
        result_.touching.assign(mesh().vertex_count(), false);
        for (const ContactList& list : report.contacts) {
            for (const uint32_t v : list.vertices) {
                result_.touching[v] = true;
            }
        }
    }

    void count_steps(const std::vector<PointResult>& results, EditReport& report) {
        if (results.empty()) {
            return;
        }
        report.steps.min = no_index;
        double total = 0;
        for (const PointResult& r : results) {
            report.steps.min = std::min(report.steps.min, r.steps);
            report.steps.max = std::max(report.steps.max, r.steps);
            report.steps.limit_reached += (r.flags & kernel::f64::VERTEX_LIMIT_REACHED) != 0 ? 1 : 0;
            report.samples += r.samples;
            total += r.steps;
        }
        report.steps.mean = total / static_cast<double>(results.size());
        if (report.steps.limit_reached > 0) {
            log_.warn(std::to_string(report.steps.limit_reached) +
                      " vertices reached the step limit and stopped outside the occluder: raise \"steps\": "
                      "{\"max\": "
                      "...} or shorten the path");
        }
    }

    void report_volume(EditReport& report, const std::optional<double>& free_volume) {
        if (!volume_) {
            return;
        }
        const double before = *volume_;
        if (report.moved > 0) {
            volume_ = enclosed_volume(mesh(), result_.positions);
        }
        report.volume = VolumeChange{before, *volume_, {}};
        if (!free_volume) {
            return;
        }
        report.volume->without_occluders = std::copysign(*free_volume, *volume_);
        const double error = std::abs(*volume_ / *report.volume->without_occluders - 1);
        if (report.dilation && report.dilation->solved && error > tolerated_volume_error) {
            log_.warn(
                "dilation leaves the volume " + rounded_text(100 * error) +
                " % off that of the edit without occluders: raise its \"width\", or the number of steps");
        }
    }

    void note_region(const EditRegion& region, const DeformInput& input) {
        const size_t n = region.vertices.size();
        for (size_t i = 0; i < n; ++i) {
            float& weight = result_.weights[region.vertices[i]];
            for (size_t j = 0; j < input.handle_count; ++j) {
                const double alpha = std::abs(region.shapes[j](region.fields[j * n + i]));
                weight = std::max(weight, static_cast<float>(std::min(alpha, 1.0)));
            }
        }
    }

    const Mesh& file_;
    RefinementHistory history_;
    const Recipe& recipe_;
    Backend& backend_;
    Log& log_;
    Progress& progress_;
    const FileCache* cache_;
    std::optional<EditOccluders> occluders_;
    Vec3 origin_{0};
    double diagonal_ = 0;
    ForgeResult result_;
    KeptSolvers solvers_;
    std::optional<SurfaceState> surface_; ///< of result_.positions; empty once they have changed
    std::optional<double> volume_;        ///< of result_.positions, for closed meshes
};

} // namespace

ForgeResult forge(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log, Progress& progress,
                  const FileCache* cache) {
    return Forger(mesh, recipe, backend, log, progress, cache).run();
}

} // namespace anvil
