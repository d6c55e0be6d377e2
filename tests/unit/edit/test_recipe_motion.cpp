#include "engine/occluder/occluder_motion.h"
#include "tests/unit/edit/recipe_texts.h"

using namespace anvil;
using namespace anvil::recipe_texts;

namespace {

/// An edit without handles whose occluder "o" has this motion.
std::string with_motion(const std::string& motion, const std::string& edit_extra = "") {
    return R"({"anvil": 1, "mesh": "a.ply", "occluders": [{"name": "o", )" + ball +
           R"(, "transform": {"translate": [1,2,3], "scale": 2}}], "edits": [{"kind": "translate", "occluders": [)" +
           R"({"name": "o", "motion": )" + motion + "}]" + edit_extra + "}]}";
}

const std::string blow =
    R"([{"at": 0, "translate": [0,1,0]}, {"at": 0.25, "rotate": {"axis": [0,0,2], "degrees":
    -30}}, {"at": 1, "translate": [0,0,0], "scale": 3}])";

} // namespace

TEST_CASE("a motion is read, its gaps are the transform's, and it is written as it was") {
    const Recipe recipe = parse(with_motion(blow));
    REQUIRE(recipe.edits[0].handles.empty());
    const auto poses = timed_poses(occluders_of(recipe, recipe.edits[0])[0]);
    REQUIRE(poses.size() == 3);
    CHECK(poses[0].place.origin == Vec3(0, 1, 0));
    CHECK(poses[1].place.origin == Vec3(1, 2, 3));
    CHECK(poses[1].place.axes[0].y == Approx(-0.5).epsilon(1e-15));
    CHECK(poses[1].at == 0.25);
    CHECK(poses[0].place.scale == 2);
    CHECK(poses[2].place.scale == 3);
    CHECK(parse(write_recipe(recipe)) == recipe);
    const Recipe nested = parse(with_motion(
        R"([{"at": 0, "transform": {"translate": [0,1,0]}}, {"at": 1, "transform": {"scale": 3}}])"));
    CHECK(nested.edits[0].occluders->at(0).motion[1].scale == 3.0);
    const Recipe anchored =
        parse(with_motion(blow, R"(, "anchors": [{"at": [{"vertex": 3}]}], "radius": 0.5)"));
    CHECK(parse(write_recipe(anchored)) == anchored);
}

TEST_CASE("between poses an occluder turns at equal speed and grows by equal factors") {
    const Recipe recipe = parse(with_motion(R"([{"at": 0.2, "translate": [0,0,0], "scale": 1},
        {"at": 0.6, "translate": [4,0,0], "scale": 4, "rotate": {"axis": [0,1,0], "degrees": 90}}])"));
    const auto poses = timed_poses(occluders_of(recipe, recipe.edits[0])[0]);
    CHECK(pose_at(poses, 0.1).origin == Vec3(0));
    CHECK(pose_at(poses, 0.9).origin == Vec3(4, 0, 0));
    const Placement half = pose_at(poses, 0.4);
    CHECK(glm::length(half.origin - Vec3(2, 0, 0)) < 1e-15);
    CHECK(half.scale == Approx(2).epsilon(1e-15));
    // 45 degrees about y: x goes to (c, 0, -s).
    CHECK(glm::length(half.axes[0] - Vec3(std::sqrt(0.5), 0, -std::sqrt(0.5))) < 1e-15);
    const auto part = first_part(poses, 0.4);
    REQUIRE(part.size() == 2);
    CHECK(part[0].at == Approx(0.5).epsilon(1e-15));
    CHECK(part[1].place.origin == half.origin);
}

TEST_CASE("a motion needs two poses at increasing times whose turns are plain") {
    check_complaint(with_motion("[]"), {"edits[0].occluders[0].motion", "at least two poses"});
    check_complaint(with_motion(R"([{"at": 0, "translate": [0,1,0]}])"),
                    {"edits[0].occluders[0].motion", "at least two poses", "\"transform\""});
    check_complaint(with_motion(R"([{"translate": [0,1,0]}, {"at": 1}])"),
                    {"motion[0]", "\"at\" is missing"});
    check_complaint(with_motion(R"([{"at": 0}, {"at": 1.5}])"), {"motion[1].at", "1.5", "[0, 1]"});
    check_complaint(with_motion(R"([{"at": 0.5}, {"at": 0.5}])"), {"motion[1].at", "increase"});
    check_complaint(with_motion(R"([{"at": 0}, {"at": 1, "translte": [0,1,0]}])"),
                    {"motion[1].translte", "translate"});
    check_complaint(with_motion(R"([{"at": 0}, {"at": 1, "scale": [1,2,1]}])"),
                    {"motion[1].scale", "non-uniform"});
    check_complaint(with_motion(R"([{"at": 0, "rotate": {"axis": [0,1,0], "degrees": 0}},
                                    {"at": 1, "rotate": {"axis": [0,-2,0], "degrees": 180}}])"),
                    {"motion[1].rotate", "180 degrees", "poses between"});
    check_complaint(with_motion(R"([{"at": 0}, {"at": 1, "scale": 2, "transform": {"scale": 2}}])"),
                    {"motion[1]", "either"});
    check_complaint(with_occluder(ball + R"(, "motion": [])"), {"occluders[0].motion", "edit's own"});
}

TEST_CASE("an edit without handles has a hammer and nothing that belongs to handles") {
    check_complaint(R"({"anvil": 1, "mesh": "a", "edits": [{"kind": "translate", "handles": []}]})",
                    {"edits[0]", "at least one handle", "motion"});
    check_complaint(with_motion(blow, R"(, "shape": "smooth")"), {"edits[0].shape", "handles"});
    check_complaint(with_motion(blow, R"(, "radius": 0.2)"), {"edits[0].radius", "anchors"});
    check_complaint(with_motion(blow, R"(, "anchors": [{"handle": 0, "at": [{"vertex": 3}]}])"),
                    {"anchors[0].handle", "no handles"});
    check_complaint(replaced(with_motion(blow), R"("kind": "translate")",
                             R"("kind": "rotate", "axis": {"origin": [0,0,0], "direction": [0,1,0]})"),
                    {"edits[0].kind", "translate"});
}
