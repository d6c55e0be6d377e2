#include "app/viewer/frame_log.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

FrameLog::Clock::time_point at(int milliseconds) {
    return FrameLog::Clock::time_point{} + std::chrono::milliseconds(1000 + milliseconds);
}

} // namespace

TEST_CASE("the frame log tells frames that draw the surface from those that draw panels alone") {
    FrameLog log;
    int now = 0;
    for (int i = 1; i <= 20; ++i) { // 1 to 20 ms
        log.frame(at(now));
        log.draws(FrameKind::whole_surface);
        now += i;
    }
    for (int i = 0; i < 3; ++i) {
        log.frame(at(now));
        now += 2;
    }
    log.frame(at(now));
    const std::string report = log.report();
    CHECK(report.find("23 frames") == 0);
    CHECK(report.find("whole surface: 20 frames, median 10 ms, 95 % 19 ms, longest 20 ms") !=
          std::string::npos);
    CHECK(report.find("panels alone: 3 frames, median 2 ms, 95 % 2 ms, longest 2 ms") != std::string::npos);
    CHECK(report.find("parts") == std::string::npos);
    CHECK(log.report().find("0 frames") == 0); // since the last report
}

TEST_CASE("the frame log says what the longest frame was at, and counts no waiting for events") {
    FrameLog log;
    log.frame(at(0));
    log.enter(FramePart::idle, at(1));
    log.enter(FramePart::events, at(501)); // a person who does nothing is no freeze
    log.enter(FramePart::panels, at(503));
    log.enter(FramePart::submitting, at(510));
    log.enter(FramePart::showing, at(600));
    log.frame(at(601));
    log.enter(FramePart::panels, at(602));
    log.frame(at(605));
    const std::string report = log.report();
    CHECK(report.find("2 frames") == 0);
    CHECK(report.find("longest 101 ms (submitting 90, panels 7; own processor time ") != std::string::npos);
}
