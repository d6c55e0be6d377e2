#include "app/viewer/disposer.h"

#include <atomic>
#include <catch2/catch.hpp>

using namespace anvil;

namespace {

struct Mark {
    std::atomic<int>* ended;
    std::atomic<bool>* elsewhere;
    std::thread::id made_on = std::this_thread::get_id();

    Mark(std::atomic<int>* count, std::atomic<bool>* other) : ended(count), elsewhere(other) {}
    ~Mark() {
        *elsewhere = std::this_thread::get_id() != made_on;
        ++*ended;
    }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;
};

} // namespace

TEST_CASE("what the window lets go of ends on another thread, and all of it before the disposer does") {
    std::atomic<int> ended = 0;
    std::atomic<bool> elsewhere = false;
    const auto held = std::make_shared<Mark>(&ended, &elsewhere);
    {
        Disposer disposer;
        disposer.take(std::make_shared<Mark>(&ended, &elsewhere));
        disposer.take(held);
        disposer.take(std::shared_ptr<Mark>());
        for (int i = 0; i < 100; ++i) {
            disposer.take_value(
                std::vector<std::shared_ptr<Mark>>{std::make_shared<Mark>(&ended, &elsewhere)});
        }
    }
    CHECK(ended == 101); // but for what somebody still has
    CHECK(elsewhere);
}
