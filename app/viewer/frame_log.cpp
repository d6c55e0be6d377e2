#include "app/viewer/frame_log.h"

#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <numeric>
#include <utility>

namespace anvil {

namespace {

constexpr double named_share = 0.05; ///< of a frame: what took less is not worth a word

constexpr std::array<const char*, static_cast<size_t>(FramePart::count)> part_names{
    "idle",      "events",    "session",    "panels",  "waiting for the device", "waiting for an image",
    "preparing", "recording", "submitting", "showing", "writing pictures"};
constexpr std::array<const char*, static_cast<size_t>(FrameKind::count)> kind_names{
    "panels alone", "whole surface", "parts of the surface"};

double processor_seconds(clockid_t clock) {
    std::timespec now{};
    ::clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string tenths(double value) {
    return rounded_text(std::round(value * 10) / 10);
}

} // namespace

double FrameLog::Frame::milliseconds() const {
    return std::accumulate(parts.begin(), parts.end(), 0.0) - parts[static_cast<size_t>(FramePart::idle)];
}

void FrameLog::enter(FramePart part, Clock::time_point now) {
    if (entered_ != Clock::time_point{}) {
        current_.parts[static_cast<size_t>(part_)] +=
            std::chrono::duration<double, std::milli>(now - entered_).count();
    }
    part_ = part;
    entered_ = now;
}

void FrameLog::frame(Clock::time_point now) {
    const bool first = entered_ == Clock::time_point{};
    const double own = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
    enter(FramePart::events, now);
    if (!first) {
        current_.own = 1000 * (own - own_seconds_);
        frames_.push_back(current_);
    }
    current_ = {};
    own_seconds_ = own;
}

std::string FrameLog::parts_of(const Frame& frame) {
    std::vector<std::pair<double, const char*>> parts;
    for (size_t i = static_cast<size_t>(FramePart::idle) + 1; i < part_names.size(); ++i) {
        if (frame.parts[i] >= named_share * frame.milliseconds()) {
            parts.emplace_back(frame.parts[i], part_names[i]);
        }
    }
    std::sort(parts.rbegin(), parts.rend());
    std::string text;
    for (const auto& [milliseconds, name] : parts) {
        text += (text.empty() ? "" : ", ") + std::string(name) + " " + tenths(milliseconds);
    }
    return text;
}

std::string FrameLog::describe(std::vector<Frame> frames) {
    std::sort(frames.begin(), frames.end(),
              [](const Frame& a, const Frame& b) { return a.milliseconds() < b.milliseconds(); });
    const auto at = [&](size_t percent) {
        return tenths(frames[(frames.size() - 1) * percent / 100].milliseconds());
    };
    return std::to_string(frames.size()) + " frames, median " + at(50) + " ms, 95 % " + at(95) +
           " ms, longest " + at(100) + " ms (" + parts_of(frames.back()) + "; own processor time " +
           tenths(frames.back().own) + ")";
}

std::string FrameLog::report() {
    const double processor = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    std::string text = std::to_string(frames_.size()) + " frames";
    if (!frames_.empty()) {
        text += ", processor " +
                tenths(1000 * (processor - processor_seconds_) / static_cast<double>(frames_.size())) + " ms";
    }
    for (size_t kind = 0; kind < kind_names.size(); ++kind) {
        std::vector<Frame> alike;
        std::copy_if(frames_.begin(), frames_.end(), std::back_inserter(alike),
                     [&](const Frame& frame) { return static_cast<size_t>(frame.kind) == kind; });
        if (!alike.empty()) {
            text += "\n  " + std::string(kind_names[kind]) + ": " + describe(std::move(alike));
        }
    }
    frames_.clear();
    processor_seconds_ = processor;
    return text;
}

} // namespace anvil
