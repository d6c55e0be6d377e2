// How the workbench shows a drag.
#include "app/viewer/workbench.h"

#include "app/viewer/conditioning.h"
#include "engine/forge/edit_region.h"

#include <algorithm>
#include <chrono>

namespace anvil {

namespace {

std::vector<RegionMark> marks_of(const EditRegion& region) {
    const size_t n = region.vertices.size();
    std::vector<RegionMark> marks(n, {0, static_cast<float>(infinity)});
    for (size_t j = 0; j < region.shapes.size(); ++j) {
        for (size_t i = 0; i < n; ++i) {
            const double t = region.fields[j * n + i];
            if (t <= 1) {
                const auto weight = static_cast<float>(std::abs(region.shapes[j](t)));
                marks[i].weight = std::max(marks[i].weight, weight);
                marks[i].distance = std::min(marks[i].distance, static_cast<float>(t * region.radii[j]));
            }
        }
    }
    for (RegionMark& mark : marks) {
        mark = std::isfinite(mark.distance) ? mark : RegionMark{};
    }
    return marks;
}

/// Where each handle is, by the vertices that carry it.
std::vector<Vec3> handle_ends(const EditRegion& region, std::span<const Vec3> positions,
                              std::span<const Vec3> at_rest) {
    std::vector<Vec3> ends;
    for (const auto& weights : region.handle_weights) {
        Vec3 end(0);
        for (const VertexWeight& w : weights) {
            const size_t at = region.index_of(w.vertex);
            end += w.weight * (at < positions.size() ? positions[at] : at_rest[w.vertex]);
        }
        ends.push_back(end);
    }
    return ends;
}

Buffer narrow_buffer(DeviceState& device, const std::vector<Vec3>& values, const Vec3& origin) {
    std::vector<glm::vec3> narrow;
    narrow.reserve(values.size());
    std::transform(values.begin(), values.end(), std::back_inserter(narrow),
                   [&](const Vec3& v) { return glm::vec3(v - origin); });
    return storage_buffer(device, std::span<const glm::vec3>(narrow));
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

void Workbench::preview(const Edit& edit, Progress& /*progress*/) {
    Recipe underway = document().recipe();
    underway.edits.push_back(with_poses(underway, edit));
    const auto start = std::chrono::steady_clock::now();
    const auto refuse = [this] {
        const Solution& solution = session_->motion().solution;
        refuse_ill_conditioned(solution.condition, solution.amplification);
    };
    if (session_) {
        session_->update(edit, *occluders_);
        try {
            refuse();
        } catch (...) {
            session_->update(previewed_, *occluders_);
            throw;
        }
    } else {
        session_ = std::make_unique<DragSession>(scene(), *occluders_, *backend_, edit, log_);
        regions_seen_ = 0;
        shapes_seen_ = 0;
        probe_.reset();
        contact_seconds_ = 0;
        try {
            refuse();
        } catch (...) {
            session_.reset();
            throw;
        }
    }
    previewed_ = edit;
    session_->wait();
    show_drag(milliseconds_since(start));
    autosave_.offer(underway, log_);
}

void Workbench::show_drag(double milliseconds) {
    const EditRegion& region = session_->region();
    Shown next = *shown();
    next.region = drawn_region();
    next.device = session_->device_name();
    DragView view{session_->edit(),
                  region.handle_positions,
                  {},
                  region.vertices.size(),
                  session_->motion().solution.condition,
                  milliseconds,
                  {}};
    const std::vector<Vec3> ends = session_->positions();
    view.ends = handle_ends(region, ends, surface_->positions);
    view.contact = drag_contact(ends, false);
    next.drag = std::move(view);
    next.outcome.reset();
    publish(next);
}

std::shared_ptr<const DrawnRegion> Workbench::drawn_region() {
    auto drawn = std::make_shared<DrawnRegion>();
    drawn->vertices = session_->normal_vertices();
    const DragWork& done = session_->work();
    if (device_->info().type == DeviceType::cpu && (!marks_ || done.regions != regions_seen_)) {
        split_ = split_triangles(device_->state(), *surface_->mesh, surface_->positions, drawn->vertices);
    }
    drawn->inside = split_.inside;
    drawn->outside = split_.outside;
    if (!marks_ || done.regions != regions_seen_ || done.shapes != shapes_seen_) {
        marks_ = std::make_shared<Buffer>(
            storage_buffer(device_->state(), std::span<const RegionMark>(marks_of(session_->region()))));
        regions_seen_ = done.regions;
        shapes_seen_ = done.shapes;
    }
    drawn->marks = marks_;
    drawn->kept = session_->session();
    if (const auto surface = device_surface(*drawn->kept, *device_)) {
        drawn->surface = *surface;
        return drawn;
    }
    const Vec3 origin = surface_->frame.origin;
    drawn->ends = narrow_buffer(device_->state(), session_->positions(), origin);
    drawn->normals = narrow_buffer(device_->state(), session_->normals(), Vec3(0));
    drawn->surface = {drawn->ends.handle(), drawn->normals.handle(),
                      static_cast<uint32_t>(session_->region().vertices.size()),
                      static_cast<uint32_t>(drawn->vertices.size())};
    return drawn;
}

void Workbench::drop_preview() {
    session_.reset();
    marks_.reset();
    split_ = {};
    Shown next = *shown();
    next.region.reset();
    next.drag.reset();
    next.outcome.reset();
    next.standing.reset();
    publish(next);
}

} // namespace anvil
