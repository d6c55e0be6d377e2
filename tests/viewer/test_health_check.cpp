#include "app/viewer/health_check.h"

#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <thread>

using namespace anvil;

namespace {

bool says(const std::vector<HealthAdvice>& advice, const std::string& text) {
    return std::any_of(advice.begin(), advice.end(), [&](const HealthAdvice& one) {
        return one.finding.find(text) != std::string::npos && !one.mend.empty();
    });
}

} // namespace

TEST_CASE("a sound mesh has no advice, a damaged one has a line with a remedy for each damage") {
    CHECK(advice_on(examine(make_sample("icosphere", 642))).empty());
    CHECK(says(advice_on(examine(make_sample("plane", 121))), "open"));
    Mesh mesh = make_sample("icosphere", 642);
    mesh.positions.emplace_back(2, 2, 2);
    mesh.positions.push_back(mesh.positions[0]);
    const auto advice = advice_on(examine(mesh));
    CHECK(says(advice, "2 vertices without a face"));
    CHECK(says(advice, "1 vertices at the position of another"));
}

TEST_CASE("the mesh that was given last is the one that is judged, however many are under way") {
    std::atomic<int> done = 0;
    HealthCheck check([&] { ++done; });
    CHECK(check.result() == nullptr);
    check.start(std::make_shared<const Mesh>(make_sample("icosphere", 10242)));
    check.start(std::make_shared<const Mesh>(make_sample("plane", 121)));
    for (int i = 0; i < 2000 && check.result() == nullptr; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    REQUIRE(check.result() != nullptr);
    CHECK(check.result()->vertices == 121);
    check.start(std::make_shared<const Mesh>(make_sample("icosphere", 42)));
    CHECK((check.result() == nullptr || check.result()->vertices == 42));
}
