#include "app/viewer/disposer.h"

#include <atomic>
#include <catch2/catch.hpp>

using namespace anvil;

namespace {

struct Mark {
    std::atomic<int>* ended;
    std::atomic<int>* here; ///< of those, on the thread that made them
    std::thread::id made_on = std::this_thread::get_id();

    Mark(std::atomic<int>* count, std::atomic<int>* own) : ended(count), here(own) {}
    ~Mark() {
        *here += std::this_thread::get_id() == made_on ? 1 : 0;
        ++*ended;
    }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;
};

} // namespace

TEST_CASE("what the window lets go of ends on another thread, and all of it before the disposer does") {
    std::atomic<int> ended = 0;
    std::atomic<int> here = 0;
    const auto held = std::make_shared<Mark>(&ended, &here);
    {
        Disposer disposer;
        disposer.take(std::make_shared<Mark>(&ended, &here));
        disposer.take(held);
        disposer.take(std::shared_ptr<Mark>());
        for (int i = 0; i < 100; ++i) {
            std::vector<std::shared_ptr<Mark>> marks; // braces would keep a second hold of what is in them
            marks.push_back(std::make_shared<Mark>(&ended, &here));
            disposer.take_value(std::move(marks));
        }
    }
    CHECK(ended == 101); // but for what somebody still has
    CHECK(here == 0);
}
