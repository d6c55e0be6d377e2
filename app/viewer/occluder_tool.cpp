#include "app/viewer/occluder_tool.h"

#include "app/viewer/recorded_motion.h"
#include "app/viewer/window.h"

#include <algorithm>
#include <utility>

namespace anvil {

namespace {

constexpr double motion_tolerance = 0.002; ///< of the scene's size
constexpr double turn_size = 0.1;          ///< of it: how far from the middle a turn is judged
constexpr double longest_turn = 45;        ///< degrees between poses that a typed turn is recorded at

std::vector<MotionPose> motion_of(const std::vector<Transform>& poses, double size) {
    return recorded_motion(poses, turn_size * size, motion_tolerance * size);
}

} // namespace

void OccluderTool::set_scene_size(double size) {
    size_ = size;
}

OccluderWish OccluderTool::take_wish() {
    return std::exchange(wish_, OccluderWish::nothing);
}

void OccluderTool::select(const std::string& name) {
    if (name != selected_) {
        drag_.reset();
        taken_.reset();
        way_.clear();
        hot_ = {};
        selected_ = name;
    }
}

const OccluderView* OccluderTool::find(std::span<const OccluderView> occluders) const {
    const auto found = std::find_if(occluders.begin(), occluders.end(),
                                    [&](const OccluderView& o) { return o.name == selected_; });
    return found == occluders.end() ? nullptr : &*found;
}

Transform OccluderTool::shown(const OccluderView& occluder) const {
    if (occluder.name == selected_ && drag_) {
        return drag_->now();
    }
    if (const auto recorded = samples_.find(occluder.name); recorded != samples_.end()) {
        return recorded->second.back();
    }
    return occluder.name == selected_ && taken_ ? *taken_ : occluder.transform;
}

std::vector<GizmoMark> OccluderTool::marks(const OrbitCamera& camera,
                                           std::span<const OccluderView> occluders) const {
    const OccluderView* occluder = find(occluders);
    return occluder == nullptr ? std::vector<GizmoMark>()
                               : gizmo_marks(camera, placed_point(shown(*occluder), occluder->pivot));
}

std::map<std::string, std::vector<MotionPose>> OccluderTool::motions() const {
    std::map<std::string, std::vector<Transform>> all = samples_;
    if (drag_ && !way_.empty()) {
        std::vector<Transform>& poses = all[selected_];
        poses.insert(poses.end(), way_.begin(), way_.end());
    }
    std::map<std::string, std::vector<MotionPose>> motions;
    for (const auto& [name, poses] : all) {
        std::vector<MotionPose> motion = motion_of(poses, size_);
        if (!motion.empty()) {
            motions[name] = std::move(motion);
        }
    }
    return motions;
}

void OccluderTool::clear_motions() {
    samples_.clear();
    way_.clear();
}

bool OccluderTool::handle(const InputEvent& event, const OrbitCamera& camera,
                          std::span<const OccluderView> occluders, const PickSurface* surface) {
    switch (event.kind) {
    case InputEvent::Kind::move:
        cursor_ = {event.x, event.y};
        if (drag_) {
            drag_->move(event, camera);
            sample();
            return true;
        }
        hot_ = gizmo_part_at(marks(camera, occluders), event.x, event.y);
        return false;
    case InputEvent::Kind::press:
        return press(event, camera, occluders, surface);
    case InputEvent::Kind::release:
        if (drag_ && event.button == MouseButton::left) {
            finish();
            return true;
        }
        return drag_.has_value();
    case InputEvent::Kind::key_down:
        return key(event, camera);
    case InputEvent::Kind::text:
        if (drag_ && drag_->type(event.character, camera)) {
            sample();
        }
        return drag_.has_value();
    default:
        return false; // the view is zoomed in mid-drag too
    }
}

bool OccluderTool::press(const InputEvent& event, const OrbitCamera& camera,
                         std::span<const OccluderView> occluders, const PickSurface* surface) {
    if (drag_) {
        if (event.button == MouseButton::right) {
            cancel();
        }
        return true;
    }
    if (event.button != MouseButton::left || event.modifiers.alt) {
        return false;
    }
    const OccluderView* occluder = find(occluders);
    const GizmoPart part = gizmo_part_at(marks(camera, occluders), cursor_.x, cursor_.y);
    if (occluder != nullptr && part) {
        const Transform from = shown(*occluder);
        drag_.emplace(part, from, placed_point(from, occluder->pivot), cursor_, round_step(size_));
        way_.clear();
        if (records_now()) {
            way_.push_back(from);
        }
        return true;
    }
    const Ray ray = camera.ray(cursor_.x, cursor_.y);
    const bool on_surface = surface != nullptr && surface->hit(ray).has_value();
    if (on_surface && !picks) {
        return false;
    }
    std::vector<Transform> places;
    std::transform(occluders.begin(), occluders.end(), std::back_inserter(places),
                   [this](const OccluderView& o) { return shown(o); });
    const auto found = first_occluder(ray, occluders, places);
    select(found ? occluders[*found].name : "");
    return found.has_value();
}

bool OccluderTool::key(const InputEvent& event, const OrbitCamera& camera) {
    if (!drag_) {
        const bool toggles = event.key == 'O' && !event.modifiers.control && !event.modifiers.alt;
        picks = picks != toggles;
        return toggles;
    }
    if (event.key == key_of("escape")) {
        cancel();
    } else if (event.key == key_of("enter")) {
        finish();
    } else if (drag_->key(event, camera)) {
        sample();
    }
    return true; // no other command in mid-drag
}

/// A drag that follows the cursor is recorded as it goes; one that was typed has a straight way.
void OccluderTool::sample() {
    wish_ = OccluderWish::preview;
    if (!records_now()) {
        return;
    }
    if (!drag_->is_typed()) {
        way_.push_back(drag_->now());
        return;
    }
    way_.clear();
    const auto parts = static_cast<int>(std::max(1.0, std::ceil(drag_->degrees() / longest_turn)));
    for (int i = 0; i <= parts; ++i) {
        way_.push_back(drag_->at(static_cast<double>(i) / parts));
    }
}

void OccluderTool::finish() {
    const GizmoDrag drag = *drag_;
    const bool records_it = records_now();
    drag_.reset();
    if (!drag.moved()) {
        wish_ = OccluderWish::preview;
    } else if (records_it) {
        std::vector<Transform>& poses = samples_[selected_];
        poses.insert(poses.end(), way_.begin(), way_.end());
        wish_ = OccluderWish::preview;
    } else {
        taken_ = drag.now();
        wish_ = OccluderWish::moved;
    }
    way_.clear();
}

void OccluderTool::cancel() {
    drag_.reset();
    way_.clear();
    wish_ = OccluderWish::preview;
}

} // namespace anvil
