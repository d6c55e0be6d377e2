#include "engine/forge/drag_session.h"
#include "engine/gpu/gpu_backend.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

TEST_CASE("the README's example of a drag brings its handle to where its last line asks for") {
    const Mesh mesh = make_sample("hand", 2000);
    const uint32_t tip = nearest_vertex(mesh, Vec3(0.06, 0.995, 0.06));
    const Recipe recipe =
        edit_recipe("{'kind': 'translate', 'handles': [ {'at': {'vertex': " + std::to_string(tip) +
                    "}, 'by': [0,0.01,0]} ], 'radius': 0.3}");
    Log log;
    Progress progress;

#include "readme/drag_example.inc"

    REQUIRE(places.size() == session.region().vertices.size());
    CHECK(places.size() < mesh.vertex_count());
    const Vec3 asked = mesh.positions[tip] + *edit.handles[0].by;
    // Float places relative to the middle of a hand that is 1 high.
    CHECK(glm::length(places[session.region().index_of(tip)] - asked) <= 4 * std::ldexp(1.0, -24));
    CHECK(session.work().updates == 2);
    CHECK(session.work().distances == 1);
}
