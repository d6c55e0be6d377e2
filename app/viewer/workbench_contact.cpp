#include "app/viewer/workbench.h"
#include "engine/occluder/occluder_motion.h"

#include <chrono>
#include <numeric>

namespace anvil {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double cheap_seconds = 0.01; ///< what a step may take longer by

} // namespace

/// Of the drag as it stands. Where it takes long it waits until nothing else is to be done.
std::optional<DragContact> Workbench::drag_contact(std::span<const Vec3> ends, bool whatever_it_takes) {
    if (!whatever_it_takes && contact_seconds_ > cheap_seconds) {
        return std::nullopt;
    }
    const auto start = Clock::now();
    const size_t regions = session_->work().regions;
    if (!probe_ || probed_region_ != regions) {
        probe_.emplace(scene().mesh().triangles, scene().incidence(), scene().positions(),
                       session_->region().vertices);
        probed_region_ = regions;
    }
    DragContact contact;
    contact.touching = probe_->measure(at_end(session_->input().occluders), surface_->frame.origin, ends);
    if (surface_->volume) {
        contact.volume = {*surface_->volume, *surface_->volume + probe_->volume_change(ends)};
    }
    contact_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    return contact;
}

void Workbench::measure_contact() {
    if (!session_ || !shown()->drag) {
        return;
    }
    Shown next = *shown();
    next.drag->contact = drag_contact(session_->positions(), true);
    publish(next);
}

void Workbench::touch(const Edit& uses) {
    const LocalFrame& frame = scene().frame();
    const OccluderSet set =
        occluders_->set_for(uses, {frame.origin, frame.diagonal, 0.5 * frame.diagonal}, "edit");
    if (!whole_) {
        std::vector<uint32_t> all(surface_->positions.size());
        std::iota(all.begin(), all.end(), 0);
        whole_.emplace(scene().mesh().triangles, scene().incidence(), scene().positions(), all);
    }
    Shown next = *shown();
    next.standing = whole_->measure(at_end(set), frame.origin, surface_->positions);
    publish(next);
}

} // namespace anvil
