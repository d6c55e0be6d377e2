#include "tests/unit/document/session.h"

using namespace anvil;
using namespace anvil::test;

TEST_CASE("what is foreseen is what a step then makes, at no further cost, and nothing until then") {
    Session s;
    const auto document = s.open();
    document->change(s.story(document->recipe())[0], "Step", s.work);
    const DocumentState before = document->state();
    for (const Recipe& next : s.story(Recipe{"", document->recipe().mesh, {}, {}})) {
        const auto made = document->foresee(next, s.work);
        REQUIRE(made.size() == next.edits.size() + 1);
        CHECK(document->state().recipe == before.recipe);
        CHECK(document->state().surface == before.surface);
        CHECK(document->state().undo == before.undo);
        CHECK(made.front()->positions == document->mesh()->positions);
        CHECK(made.back()->positions ==
              anvil::test::forged(*document->mesh(), next, *s.backend, s.log).positions);
    }
    const Recipe next = s.story(Recipe{"", document->recipe().mesh, {}, {}}).back();
    const auto made = document->foresee(next, s.work);
    const size_t applied = document->versions().edits_applied();
    document->change(next, "Foreseen", s.work);
    CHECK(document->versions().edits_applied() == applied);
    CHECK(document->surface() == made.back());
    check_as_forged(*document, s);
}

TEST_CASE("a recipe that is wrong cannot be foreseen, and a long one can be cancelled") {
    Session s;
    const auto document = s.open();
    Recipe next = s.story(document->recipe()).back();
    next.edits[0].radius = -1;
    CHECK_THROWS_AS(document->foresee(next, s.work), InputError);
    Progress cancelled;
    cancelled.cancel();
    const EditWork work{*s.backend, s.log, cancelled};
    CHECK_THROWS_AS(document->foresee(s.story(document->recipe()).back(), work), Cancelled);
    CHECK(document->recipe().edits.empty());
    // Dilation is one edit and can take long: it hears too.
    Recipe swelling = document->recipe();
    swelling.occluders.push_back({"ball", {SphereShape{0.3}}, {}, {Vec3(0, 1.35, 0)}, {}});
    swelling.edits.push_back(with_poses(swelling, pull(Vec3(0, 1, 0), 0.2)));
    swelling.edits.back().dilation = Dilation{};
    Progress* hearing = nullptr;
    Progress stopping([&](const std::string& stage, double) {
        if (stage == "dilation") {
            hearing->cancel();
        }
    });
    hearing = &stopping;
    const EditWork stopped{*s.backend, s.log, stopping};
    CHECK_THROWS_AS(document->change(swelling, "Swell", stopped), Cancelled);
    CHECK(document->recipe().edits.empty());
    CHECK_FALSE(document->can_undo());
    CHECK_NOTHROW(document->change(swelling, "Swell", s.work));
}
