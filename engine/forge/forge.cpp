#include "engine/forge/forge.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/forge/dilation.h"
#include "engine/forge/edit_motion.h"
#include "engine/forge/edit_region.h"
#include "engine/forge/refine_edit.h"
#include "engine/forge/surface_state.h"
#include "engine/forge/volume.h"
#include "engine/occluder/occluder_motion.h"
#include "engine/refine/point_vertices.h"
#include "engine/refine/space_criterion.h"

#include <algorithm>
#include <chrono>
#include <map>
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
        const Box box = bounds(mesh);
        origin_ = box.empty() ? Vec3(0) : box.centre();
        diagonal_ = box.diagonal();
    }

    ForgeResult run() {
        result_.report.device = backend_.device_name();
        result_.report.driver = backend_.driver_name();
        if (is_closed(mesh())) {
            volume_ = enclosed_volume(mesh(), result_.positions);
        }
        try {
            build_models();
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

    void build_models() {
        const StageTimer timer(seconds().bake);
        for (size_t i = 0; i < recipe_.occluders.size(); ++i) {
            const Occluder& occluder = recipe_.occluders[i];
            try {
                models_.emplace(occluder.name, build_model(occluder.shape, field_of(occluder), progress_,
                                                           {recipe_folder(recipe_), &log_}, cache_));
            } catch (const InputError& error) {
                throw InputError("occluders[" + std::to_string(i) + "] \"" + occluder.name +
                                 "\": " + error.what());
            }
        }
    }

    OccluderSet occluders(const Edit& edit, double radius, const std::string& place) const {
        OccluderSet set;
        try {
            for (const OccluderUse& use : occluders_of(recipe_, edit)) {
                add_occluder(set, models_.at(use.name), use.name, *use.transform, *use.influence,
                             {origin_, diagonal_, radius});
                set_motion(set, local_motion(use, edit.amount));
            }
        } catch (const InputError& error) {
            throw InputError(place + ": " + error.what());
        }
        return set;
    }

    std::vector<TimedPose> local_motion(const OccluderUse& use, double amount) const {
        std::vector<TimedPose> poses = first_part(timed_poses(use), amount);
        for (TimedPose& pose : poses) {
            pose.place.origin -= origin_;
        }
        return poses;
    }

    void apply(const Edit& edit, const std::string& place) {
        EditReport report;
        report.kind = edit.kind == EditKind::translate ? "translate" : "rotate";
        const size_t points_added = edit.refine ? make_points_vertices(edit, place) : 0;
        EditRegion region = measure_region(edit, place);
        if (edit.refine) {
            region = refine_region(edit, region, place, points_added, report);
        }
        report.radii = region.radii;
        report.region = region.vertices.size();
        report.distance_methods = region.methods;

        DeformInput input = prepare_input(edit, region, place);
        const EditMotion motion = solve(edit, region, input, place, report);
        std::optional<double> free_volume;
        const auto results = edit.dilation && !input.occluders.empty()
                                 ? dilated(edit, region, input, motion.motion, place, report, free_volume)
                                 : deform(input, motion.motion);
        move_vertices(region, input, results, report);
        report_triangles(region, input, report);
        report_contacts(edit, region, report);
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

    EditRegion refine_region(const Edit& edit, const EditRegion& region, const std::string& place,
                             size_t points_added, EditReport& report) {
        RefineState state;
        {
            const StageTimer timer(seconds().distance);
            state = start_refinement(edit, region, place, mesh(), result_.positions, surface());
        }
        const StageTimer timer(seconds().refine);
        const std::vector<uint32_t> pinned = pinned_vertices(edit, place, surface());
        const double angle_before = least_angle(mesh().triangles, result_.positions, region.vertices);
        const auto criterion = criterion_of(edit, region, place);
        Refinement refinement = refine(mesh().triangles, std::move(state), *criterion,
                                       options_of(*edit.refine, mesh().vertex_count()), progress_);
        EditRegion refined = region;
        if (refinement.report.added > 0) {
            adopt(divided(mesh(), std::move(refinement.state.parents), refinement.faces));
            refined = region_after(region, refinement.state, pinned);
        }
        report.refine = summary_of(refinement.report, points_added);
        report.refine->min_angle_before = angle_before;
        report.refine->min_angle_after = least_angle(mesh().triangles, result_.positions, refined.vertices);
        return refined;
    }

    /// Criteria in space run the whole edit, which the points added so far do not change.
    std::unique_ptr<EdgeCriterion> criterion_of(const Edit& edit, const EditRegion& region,
                                                const std::string& place) {
        const Refine& settings = *edit.refine;
        if (settings.criterion == RefineCriterion::shape) {
            return make_shape_criterion();
        }
        DeformInput input = prepare_input(edit, region, place);
        Log unheard; // the edit itself says it again
        const DeformMotion motion =
            find_motion(edit, region, result_.positions, origin_, place, input.occluders, unheard).motion;
        MovePoints move = [this, input, motion, radii = region.radii](
                              std::span<const Vec3> places, const std::vector<double>& distances) mutable {
            return moved_points(input, motion, radii, places, distances);
        };
        return settings.criterion == RefineCriterion::space
                   ? make_space_criterion(std::move(move))
                   : make_both_criteria(settings.shape_tolerance, std::move(move), settings.space_tolerance);
    }

    /// Where the edit takes any points of the surface; `input` serves all calls.
    std::vector<Vec3> moved_points(DeformInput& input, const DeformMotion& motion,
                                   const std::vector<double>& radii, std::span<const Vec3> places,
                                   const std::vector<double>& distances) {
        const size_t n = places.size();
        input.points.resize(n);
        std::transform(places.begin(), places.end(), input.points.begin(),
                       [this](const Vec3& p) { return p - origin_; });
        input.fields.resize(distances.size());
        for (size_t i = 0; i < distances.size(); ++i) {
            input.fields[i] = distances[i] / radii[i / n];
        }
        find_start_distances(input);
        const auto session = backend_.prepare(input);
        session->update(motion);
        const std::vector<PointResult> results = session->download();
        std::vector<Vec3> ends(n);
        std::vector<bool> inside(n);
        for (size_t i = 0; i < n; ++i) {
            ends[i] = input.points[i] + results[i].displacement;
            inside[i] = (results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0;
        }
        if (!input.occluders.empty() && !input.occluders.paper) {
            finish_contact(input.occluders, input.points, inside, ends);
        }
        for (size_t i = 0; i < n; ++i) {
            bool reached = false;
            for (size_t f = i; f < input.fields.size(); f += n) {
                reached = reached || input.fields[f] <= 1;
            }
            // What lies outside of the region stays, even where an occluder moves.
            ends[i] = reached ? ends[i] + origin_ : places[i];
        }
        return ends;
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
        result_.refined = std::move(refined.mesh);
        surface_.reset(); // it knows the mesh before
    }

    SurfaceState& surface() {
        if (!surface_) {
            surface_.emplace(mesh(), result_.positions, history_);
        }
        return *surface_;
    }

    EditRegion measure_region(const Edit& edit, const std::string& place) {
        const StageTimer timer(seconds().distance);
        return find_region(edit, place, surface());
    }

    DeformInput prepare_input(const Edit& edit, const EditRegion& region, const std::string& place) {
        const StageTimer timer(seconds().solve);
        DeformInput input;
        input.handle_count = region.shapes.size();
        input.fields = region.fields;
        input.points.reserve(region.vertices.size());
        for (uint32_t v : region.vertices) {
            input.points.push_back(result_.positions[v] - origin_);
        }
        for (const ShapeFunction& shape : region.shapes) {
            input.shapes.push_back({static_cast<uint32_t>(input.segments.size()),
                                    static_cast<uint32_t>(shape.segments().size())});
            for (const auto& s : shape.segments()) {
                input.segments.push_back({s.begin, s.c0, s.c1, s.c2, s.c3});
            }
        }
        input.occluders = occluders(edit, largest_radius(region), place);
        find_start_distances(input);
        return input;
    }

    /// How far the edit reaches; a hammer on a whole mesh: half of it.
    double largest_radius(const EditRegion& region) const {
        return region.radii.empty() ? 0.5 * diagonal_
                                    : *std::max_element(region.radii.begin(), region.radii.end());
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
        const double width = edit.dilation->width.value_or(0.5 * largest_radius(region));
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

    /// Adds the displacements in double; where occluders are, the exact finish decides.
    void move_vertices(const EditRegion& region, const DeformInput& input,
                       const std::vector<PointResult>& results, EditReport& report) {
        const StageTimer timer(seconds().deform);
        std::vector<Vec3> ends(input.points.size());
        std::vector<bool> inside(input.points.size(), false);
        for (size_t i = 0; i < ends.size(); ++i) {
            if (!is_finite(results[i].displacement)) {
                throw InternalError("vertex " + std::to_string(region.vertices[i]) +
                                    " was moved to no place");
            }
            ends[i] = input.points[i] + results[i].displacement;
            inside[i] = (results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0;
        }
        const std::vector<Vec3> unfinished = ends;
        if (!input.occluders.empty()) {
            report.contact = ContactReport{};
            report.contact->started_inside =
                static_cast<size_t>(std::count(inside.begin(), inside.end(), true));
            if (!input.occluders.paper) {
                report.contact->finished_on_cpu = finish_contact(input.occluders, input.points, inside, ends);
            }
            measure_vertices(at_end(input.occluders), ends, inside, *report.contact);
        }
        for (size_t i = 0; i < ends.size(); ++i) {
            const Vec3 displacement = results[i].displacement + (ends[i] - unfinished[i]);
            Vec3& position = result_.positions[region.vertices[i]];
            const Vec3 end = position + displacement;
            report.moved += end != position ? 1 : 0;
            result_.moved[region.vertices[i]] = result_.moved[region.vertices[i]] || end != position;
            position = end;
        }
        if (report.moved > 0) {
            surface_.reset(); // it knows the positions before
        }
        count_steps(results, report);
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

    void report_triangles(const EditRegion& region, const DeformInput& input, EditReport& report) {
        if (input.occluders.empty()) {
            return;
        }
        const StageTimer timer(seconds().deform);
        std::vector<bool> in_region(mesh().vertex_count(), false);
        for (uint32_t v : region.vertices) {
            in_region[v] = true;
        }
        std::vector<Triangle> triangles;
        std::vector<uint32_t> places;
        for (uint32_t i = 0; i < mesh().triangles.size(); ++i) {
            const Triangle& t = mesh().triangles[i];
            if (in_region[t[0]] || in_region[t[1]] || in_region[t[2]]) {
                triangles.push_back(t);
                places.push_back(i);
            }
        }
        measure_triangles(at_end(input.occluders), result_.positions, origin_, triangles, *report.contact);
        for (OccluderContact& occluder : report.contact->occluders) {
            for (uint32_t& triangle : occluder.triangles) {
                triangle = places[triangle];
            }
        }
    }

    /// From the region's points and the mesh's triangles to the file's numbers.
    void report_contacts(const Edit& edit, const EditRegion& region, EditReport& report) {
        if (!report.contact) {
            return;
        }
        result_.touching.assign(mesh().vertex_count(), false);
        const std::vector<OccluderUse> uses = occluders_of(recipe_, edit);
        for (size_t k = 0; k < uses.size(); ++k) {
            ContactList list{uses[k].name, {}, {}};
            for (const uint32_t point : report.contact->occluders[k].points) {
                list.vertices.push_back(region.vertices[point]);
                result_.touching[region.vertices[point]] = true;
            }
            uint32_t face = 0;
            for (const uint32_t triangle : report.contact->occluders[k].triangles) {
                while (mesh().first_triangle(face + size_t{1}) <= triangle) {
                    ++face;
                }
                list.triangles.push_back(
                    {face, triangle - static_cast<uint32_t>(mesh().first_triangle(face))});
            }
            report.contacts.push_back(std::move(list));
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
    std::map<std::string, OccluderModel> models_;
    Vec3 origin_{0};
    double diagonal_ = 0;
    ForgeResult result_;
    std::optional<SurfaceState> surface_; ///< of result_.positions; empty once they have changed
    std::optional<double> volume_;        ///< of result_.positions, for closed meshes
};

} // namespace

ForgeResult forge(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log, Progress& progress,
                  const FileCache* cache) {
    return Forger(mesh, recipe, backend, log, progress, cache).run();
}

} // namespace anvil
