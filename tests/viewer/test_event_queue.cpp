#include "app/viewer/event_queue.h"
#include "app/viewer/window.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

using Kind = InputEvent::Kind;

InputEvent event(Kind kind, int key = 0) {
    InputEvent made;
    made.kind = kind;
    made.key = key;
    return made;
}

std::vector<size_t> frames_of(const std::vector<InputEvent>& events) {
    EventQueue queue;
    queue.add(events);
    std::vector<size_t> sizes;
    while (!queue.empty()) {
        sizes.push_back(queue.take_frame().size());
        REQUIRE(sizes.back() > 0);
    }
    return sizes;
}

} // namespace

TEST_CASE("a double click between two frames is four frames, none of which misses a change") {
    const InputEvent press = event(Kind::press);
    const InputEvent release = event(Kind::release);
    CHECK(frames_of({press, release, press, release}) == std::vector<size_t>{1, 1, 1, 1});
}

TEST_CASE("a drag begins where it was pressed, and moves between two frames are one") {
    const InputEvent move = event(Kind::move);
    CHECK(frames_of({move, move, event(Kind::press), move, move, move}) == std::vector<size_t>{3, 3});
}

TEST_CASE("a key goes down and up in two frames, repeats in one, and Enter comes after what was typed") {
    const int enter = key_of("enter");
    CHECK(frames_of({event(Kind::key_down, 'X'), event(Kind::key_up, 'X')}) == std::vector<size_t>{1, 1});
    CHECK(frames_of({event(Kind::key_down, 'X'), event(Kind::key_down, 'X')}) == std::vector<size_t>{2});
    CHECK(frames_of({event(Kind::text), event(Kind::text), event(Kind::key_down, enter)}) ==
          std::vector<size_t>{2, 1});
    CHECK(frames_of({event(Kind::key_down, 'A'), event(Kind::text), event(Kind::key_down, 'B'),
                     event(Kind::text)}) == std::vector<size_t>{4});
}

TEST_CASE("events come out in the order that they went in") {
    EventQueue queue;
    std::vector<InputEvent> events;
    for (int i = 0; i < 20; ++i) {
        events.push_back(event(i % 3 == 0   ? Kind::key_down
                               : i % 3 == 1 ? Kind::key_up
                                            : Kind::text,
                               300 + i / 3));
        events.back().character = static_cast<uint32_t>(i);
    }
    queue.add(events);
    uint32_t next = 0;
    while (!queue.empty()) {
        for (const InputEvent& one : queue.take_frame()) {
            CHECK(one.character == next++);
        }
    }
    CHECK(next == 20);
}
