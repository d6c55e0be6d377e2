#include "engine/core/error.h"
#include "engine/edit/surface_address.h"

#include <catch2/catch.hpp>

using namespace anvil;
using Catch::Matchers::Contains;

TEST_CASE("the three written forms of a point are read") {
    CHECK(std::get<VertexAddress>(parse_address("v:12")).vertex == 12);
    CHECK(std::get<FaceAddress>(parse_address("f:3:0.2,0.3,0.5")) == FaceAddress{3, 0, {0.2, 0.3, 0.5}});
    CHECK(std::get<FaceAddress>(parse_address("f:3.1:0,1,0")) == FaceAddress{3, 1, {0, 1, 0}});
    CHECK(std::get<NearestAddress>(parse_address("-1.5,2e3,0")).point == Vec3(-1.5, 2000, 0));
}

TEST_CASE("other text is refused with the three forms") {
    for (const char* bad :
         {"", "v:", "v:-1", "v:1.5", "v:4294967295", "v:99999999999", "12", "1,2", "1,2,3,4", "1, 2, 3",
          "f:1", "f:1:0,1", "f:a:0,0,1", "f:1.:0,0,1", "x:1", "nan,0,0", "inf,0,0", "1e999,0,0"}) {
        INFO(bad);
        CHECK_THROWS_WITH(parse_address(bad), Contains(bad) && Contains("v:INDEX") && Contains("x,y,z"));
        CHECK_THROWS_AS(parse_address(bad), InputError);
    }
    CHECK_THROWS_WITH(parse_address("f:1:0.5,0.6,0"), Contains("f:1:0.5,0.6,0") && Contains("sum to 1"));
    CHECK_THROWS_WITH(parse_address("f:1:nan,0,1"), Contains("v:INDEX"));
}

TEST_CASE("points describe themselves for messages") {
    CHECK(describe(parse_address("v:12")) == "vertex 12");
    CHECK(describe(parse_address("f:3.1:0.25,0.25,0.5")) == "face 3 triangle 1 at 0.25,0.25,0.5");
    CHECK(describe(parse_address("1,2,3")) == "the surface point nearest to 1,2,3");
}
