#include "engine/forge/apply_edit.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/forge/contact_lists.h"
#include "engine/forge/dilation.h"
#include "engine/forge/edit_motion.h"
#include "engine/forge/edit_region.h"
#include "engine/forge/mirror_edit.h"
#include "engine/forge/refine_edit.h"
#include "engine/forge/stage_timer.h"
#include "engine/forge/surface_state.h"
#include "engine/forge/trial_run.h"
#include "engine/forge/volume.h"
#include "engine/refine/point_vertices.h"
#include "engine/refine/space_criterion.h"

#include <algorithm>
#include <optional>

namespace anvil {

namespace {

constexpr double tolerated_volume_error = 1e-3;

class EditRun {
  public:
    EditRun(SurfaceVersion before, Edit edit, const std::string& place, const EditTools& tools)
        : now_(std::move(before)), edit_(std::move(edit)), place_(place), tools_(tools) {
        now_.report = {};
        now_.seconds = {};
        now_.warnings.clear();
    }

    SurfaceVersion run() {
        edit_ = on_both_sides(edit_, place_, surface(), now_.frame.diagonal);
        EditReport& report = now_.report;
        report.kind = edit_.kind == EditKind::translate ? "translate" : "rotate";
        const size_t points_added = edit_.refine ? make_points_vertices() : 0;
        const EditRegion region = edit_.refine ? refine_region(points_added) : measure_region();
        report.radii = region.radii;
        report.region = region.vertices.size();
        report.distance_methods = region.methods;

        DeformInput input = prepare_input(region);
        const EditMotion motion = solve(region, input);
        std::optional<double> free_volume;
        const auto results = edit_.dilation && !input.occluders.empty()
                                 ? dilated(region, input, motion.motion, free_volume)
                                 : deform(input, motion.motion);
        move_vertices(region, input, results);
        report_volume(free_volume);
        note_region(region, input);
        now_.touching.resize(mesh().vertex_count(), false); // what was added touches nothing
        return std::move(now_);
    }

  private:
    size_t make_points_vertices() {
        const StageTimer timer(now_.seconds.refine);
        const std::vector<SurfacePoint> points = points_of(edit_, place_, surface());
        if (std::all_of(points.begin(), points.end(), is_vertex)) {
            return 0;
        }
        PointVertices made = make_vertices(mesh(), points);
        const size_t added = made.refined.parents.size();
        adopt(std::move(made.refined));
        return added;
    }

    EditRegion refine_region(size_t points_added) {
        RefineStart start = measure_start();
        EditRegion& region = start.region;
        const StageTimer timer(now_.seconds.refine);
        const std::vector<uint32_t> pinned = pinned_vertices(edit_, place_, surface());
        const double angle_before = least_angle(mesh().triangles, now_.positions, region.vertices);
        const auto criterion = criterion_of(start);
        Refinement refinement = refine(mesh().triangles, std::move(start.state), *criterion,
                                       options_of(*edit_.refine, mesh().vertex_count()), tools_.progress);
        if (refinement.report.added > 0) {
            adopt(divided(mesh(), std::move(refinement.state.parents), refinement.faces));
            fill_region(region, refinement.state, pinned);
        }
        now_.report.refine = summary_of(refinement.report, points_added, place_, tools_.log);
        now_.report.refine->min_angle_before = angle_before;
        now_.report.refine->min_angle_after = least_angle(mesh().triangles, now_.positions, region.vertices);
        return std::move(region);
    }

    RefineStart measure_start() {
        const StageTimer timer(now_.seconds.distance);
        return start_refinement(edit_, place_, mesh(), now_.positions, surface());
    }

    /// Criteria in space run the whole edit, which the points added so far do not change.
    std::unique_ptr<EdgeCriterion> criterion_of(const RefineStart& start) {
        const EditRegion& region = start.region;
        const Refine& settings = *edit_.refine;
        if (settings.criterion == RefineCriterion::shape) {
            return make_shape_criterion();
        }
        DeformInput input = prepare_input(region);
        Log unheard; // the edit itself says it again
        const DeformMotion motion =
            find_motion(edit_, region, now_.positions, origin(), place_, input.occluders, unheard).motion;
        std::vector<double> radii;
        for (const HandleField& handle : start.state.handles) {
            radii.push_back(handle.radius);
        }
        MovePoints move = [run = TrialRun(tools_.backend, std::move(input), motion, std::move(radii),
                                          origin())](std::span<const Vec3> places,
                                                     const std::vector<double>& distances) mutable {
            return run.moved(places, distances);
        };
        return settings.criterion == RefineCriterion::space
                   ? make_space_criterion(std::move(move), settings.space_tolerance)
                   : make_both_criteria(settings.shape_tolerance, std::move(move), settings.space_tolerance);
    }

    /// The mesh from here on.
    void adopt(RefinedMesh refined) {
        for (const VertexParents& p : refined.parents) {
            now_.positions.push_back(between(now_.positions[p.a], now_.positions[p.b], p.place));
            now_.moved.push_back(now_.moved[p.a] || now_.moved[p.b]);
            now_.weights.push_back(
                between(now_.weights[p.a], now_.weights[p.b], static_cast<float>(p.place)));
        }
        auto history = std::make_shared<RefinementHistory>(*now_.history);
        history->add(refined);
        now_.history = std::move(history);
        now_.mesh = std::make_shared<Mesh>(std::move(refined.mesh));
        leave_surface();
    }

    SurfaceState& surface() {
        if (!surface_) {
            surface_.emplace(mesh(), now_.positions, *now_.history, tools_.solvers, now_.number);
        }
        return *surface_;
    }

    /// Mesh or positions are others now.
    void leave_surface() {
        surface_.reset();
        now_.number = new_surface_number();
    }

    EditRegion measure_region() {
        const StageTimer timer(now_.seconds.distance);
        return find_region(edit_, place_, surface());
    }

    DeformInput prepare_input(const EditRegion& region) {
        const StageTimer timer(now_.seconds.solve);
        const OccluderScale scale{origin(), now_.frame.diagonal, largest_radius(region, now_.frame.diagonal)};
        return deform_input(region, now_.positions, origin(), tools_.occluders.set_for(edit_, scale, place_));
    }

    EditMotion solve(const EditRegion& region, const DeformInput& input) {
        const StageTimer timer(now_.seconds.solve);
        EditMotion motion =
            find_motion(edit_, region, now_.positions, origin(), place_, input.occluders, tools_.log);
        EditReport& report = now_.report;
        report.rank = motion.solution.rank;
        report.condition = motion.solution.condition;
        report.amplification = motion.solution.amplification;
        report.target_errors = motion.target_errors;
        return motion;
    }

    std::vector<PointResult> deform(const DeformInput& input, const DeformMotion& motion) {
        std::unique_ptr<DeformSession> session;
        {
            const StageTimer timer(now_.seconds.upload);
            session = tools_.backend.prepare(input);
        }
        {
            const StageTimer timer(now_.seconds.deform);
            session->update(motion);
            session->wait();
        }
        const StageTimer timer(now_.seconds.download);
        return session->download();
    }

    std::vector<PointResult> dilated(const EditRegion& region, const DeformInput& input,
                                     const DeformMotion& motion, std::optional<double>& free_volume) {
        const StageTimer timer(now_.seconds.deform);
        const double width =
            edit_.dilation->width.value_or(0.5 * largest_radius(region, now_.frame.diagonal));
        try {
            DilationResult result =
                dilate({mesh(), now_.positions, origin(), region, input, motion, *edit_.dilation, width,
                        now_.volume.has_value(), &tools_.progress},
                       surface());
            now_.report.dilation = DilationReport{width, result.height, edit_.dilation->solve};
            free_volume = result.free_volume;
            return std::move(result.points);
        } catch (const InputError& error) {
            throw InputError(place_ + "." + error.what());
        }
    }

    void move_vertices(const EditRegion& region, const DeformInput& input,
                       const std::vector<PointResult>& results) {
        const StageTimer timer(now_.seconds.deform);
        const EditEnds ends = finished_ends(input, results);
        for (size_t i = 0; i < ends.ends.size(); ++i) {
            const uint32_t v = region.vertices[i];
            const Vec3 end = now_.positions[v] + ends.displacements[i];
            now_.report.moved += end != now_.positions[v] ? 1 : 0;
            now_.moved[v] = now_.moved[v] || end != now_.positions[v];
            now_.positions[v] = end;
        }
        if (now_.report.moved > 0) {
            leave_surface();
        }
        count_steps(results);
        if (!input.occluders.empty()) {
            report_contact(region, input, ends);
        }
    }

    void report_contact(const EditRegion& region, const DeformInput& input, const EditEnds& ends) {
        EditReport& report = now_.report;
        std::vector<std::string> names;
        for (const OccluderUse& use : tools_.occluders.uses_of(edit_)) {
            names.push_back(use.name);
        }
        report.contact = contact_of(input, ends, region, mesh(), now_.positions, origin());
        report.contacts = contact_lists(*report.contact, names, region, mesh());
        now_.touching.assign(mesh().vertex_count(), false);
        for (const ContactList& list : report.contacts) {
            for (const uint32_t v : list.vertices) {
                now_.touching[v] = true;
            }
        }
    }

    void count_steps(const std::vector<PointResult>& results) {
        EditReport& report = now_.report;
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
            tools_.log.warn(
                std::to_string(report.steps.limit_reached) +
                " vertices reached the step limit and stopped outside the occluder: raise \"steps\": "
                "{\"max\": "
                "...} or shorten the path");
        }
    }

    void report_volume(const std::optional<double>& free_volume) {
        if (!now_.volume) {
            return;
        }
        EditReport& report = now_.report;
        const double before = *now_.volume;
        if (report.moved > 0) {
            now_.volume = enclosed_volume(mesh(), now_.positions);
        }
        report.volume = VolumeChange{before, *now_.volume, {}};
        if (!free_volume) {
            return;
        }
        report.volume->without_occluders = std::copysign(*free_volume, *now_.volume);
        const double error = std::abs(*now_.volume / *report.volume->without_occluders - 1);
        if (report.dilation && report.dilation->solved && error > tolerated_volume_error) {
            tools_.log.warn(
                "dilation leaves the volume " + rounded_text(100 * error) +
                " % off that of the edit without occluders: raise its \"width\", or the number of steps");
        }
    }

    void note_region(const EditRegion& region, const DeformInput& input) {
        const size_t n = region.vertices.size();
        for (size_t i = 0; i < n; ++i) {
            float& weight = now_.weights[region.vertices[i]];
            for (size_t j = 0; j < input.handle_count; ++j) {
                const double alpha = std::abs(region.shapes[j](region.fields[j * n + i]));
                weight = std::max(weight, static_cast<float>(std::min(alpha, 1.0)));
            }
        }
    }

    const Mesh& mesh() const { return *now_.mesh; }
    const Vec3& origin() const { return now_.frame.origin; }

    SurfaceVersion now_;
    Edit edit_; ///< on both sides of its mirror plane, once it runs
    const std::string& place_;
    const EditTools& tools_;
    std::optional<SurfaceState> surface_; ///< of now_; empty once that has changed
};

} // namespace

SurfaceVersion apply_edit(SurfaceVersion before, const Edit& edit, const std::string& place,
                          const EditTools& tools) {
    const size_t warned = tools.log.warnings.size();
    SurfaceVersion after = EditRun(std::move(before), edit, place, tools).run();
    after.warnings.assign(tools.log.warnings.begin() + static_cast<std::ptrdiff_t>(warned),
                          tools.log.warnings.end());
    return after;
}

} // namespace anvil
