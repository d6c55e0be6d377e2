#include "tests/unit/document/session.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

struct DragsAndBack {
    size_t different = 0; ///< surfaces that undoing led to and that were others on the way there
    size_t most_bytes = 0;
};

DragsAndBack drag_and_undo(Document& document, Session& s, size_t count) {
    DragsAndBack seen;
    std::vector<uint64_t> sums = {checksum(document.surface()->positions)};
    Recipe recipe = document.recipe();
    for (size_t i = 0; i < count; ++i) {
        const auto t = static_cast<double>(i);
        recipe.edits.push_back(pull(Vec3(std::cos(t), std::sin(t), 0.3 * std::sin(3 * t)), 0.02));
        document.change(recipe, "Pull", s.work);
        sums.push_back(checksum(document.surface()->positions));
        seen.most_bytes = std::max(seen.most_bytes, document.versions().bytes());
    }
    for (size_t i = count; i-- > 0;) {
        document.undo(s.work);
        seen.different += checksum(document.surface()->positions) == sums[i] ? 0 : 1;
        seen.most_bytes = std::max(seen.most_bytes, document.versions().bytes());
    }
    return seen;
}

} // namespace

TEST_CASE("a mesh opens with a recipe that does nothing, and a step of nothing is none") {
    Session s;
    const auto document = s.open();
    CHECK(document->recipe().edits.empty());
    CHECK_FALSE(document->unsaved());
    CHECK_FALSE(document->can_undo());
    CHECK(document->surface()->positions == document->mesh()->positions);
    document->change(document->recipe(), "Nothing", s.work);
    CHECK_FALSE(document->can_undo());
}

TEST_CASE("each step's surface is forge's of the same recipe, bit for bit, undone and redone too") {
    Session s;
    const auto document = s.open();
    std::vector<std::vector<Vec3>> after = {document->surface()->positions};
    std::vector<Recipe> recipes = {document->recipe()};
    for (const Recipe& next : s.story(document->recipe())) {
        document->change(next, "Step " + std::to_string(after.size()), s.work);
        check_as_forged(*document, s);
        after.push_back(document->surface()->positions);
        recipes.push_back(document->recipe());
    }
    const size_t last = after.size() - 1;
    for (size_t i = last; i-- > 0;) {
        CHECK(document->state().undo == "Step " + std::to_string(i + 1));
        document->undo(s.work);
        CHECK(document->state().redo == "Step " + std::to_string(i + 1));
        CHECK(document->surface()->positions == after[i]);
        CHECK(document->recipe() == recipes[i]);
    }
    CHECK_FALSE(document->can_undo());
    for (size_t i = 1; i <= last; ++i) {
        document->redo(s.work);
        CHECK(document->surface()->positions == after[i]);
    }
    CHECK_FALSE(document->can_redo());
    check_as_forged(*document, s);
}

TEST_CASE("surfaces that were let go of are made again, bit for bit") {
    Session s;
    s.options.budget = 1; // no more than the file's and the one shown
    const auto document = s.open();
    std::vector<std::vector<Vec3>> after = {document->surface()->positions};
    for (const Recipe& next : s.story(document->recipe())) {
        document->change(next, "Step", s.work);
        after.push_back(document->surface()->positions);
    }
    const size_t applied = document->versions().edits_applied();
    for (size_t i = after.size() - 1; i-- > 0;) {
        document->undo(s.work);
        CHECK(document->surface()->positions == after[i]);
    }
    CHECK(document->versions().edits_applied() > applied);
    while (document->can_redo()) {
        document->redo(s.work);
    }
    check_as_forged(*document, s);
}

TEST_CASE("what is measured between steps changes no bit of them") {
    Session s;
    const auto document = s.open();
    for (const Recipe& next : s.story(document->recipe())) {
        for (size_t i = 0; i <= document->recipe().edits.size(); ++i) {
            const auto before = document->surface_before(i, s.work);
            DragScene scene(*before, document->solvers());
            scene.warm();
        }
        document->change(next, "Step", s.work);
        check_as_forged(*document, s);
    }
}

TEST_CASE("changing a past edit begins at that edit and ends where forge does") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    for (int i = 0; i < 4; ++i) {
        recipe.edits.push_back(pull(Vec3(std::cos(i), std::sin(i), 0), 0.1));
        document->change(recipe, "Pull", s.work);
    }
    CHECK(document->versions().edits_applied() == 4);
    recipe.edits[2].radius = 0.3;
    document->change(recipe, "Radius", s.work);
    CHECK(document->versions().edits_applied() == 6);
    check_as_forged(*document, s);
    recipe.edits.erase(recipe.edits.begin());
    document->change(recipe, "Remove", s.work);
    CHECK(document->versions().edits_applied() == 9);
    check_as_forged(*document, s);
    document->undo(s.work);
    document->undo(s.work);
    CHECK(document->versions().edits_applied() == 9);
    recipe = document->recipe();
    recipe.edits[2].radius = 0.3; // was there before, and is undone: its surfaces are at hand
    document->change(recipe, "Radius", s.work);
    CHECK(document->versions().edits_applied() == 9);
    check_as_forged(*document, s);
}

TEST_CASE("moving an occluder changes the edits that use it where it stands, and no others") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.occluders.push_back({"ball", {SphereShape{0.3}}, {}, {Vec3(0, 1.35, 0)}, {}});
    document->change(recipe, "Add ball", s.work);
    recipe.edits.push_back(with_poses(recipe, pull(Vec3(0, 1, 0), 0.2)));
    document->change(recipe, "Pull", s.work);
    const std::vector<Vec3> pulled = document->surface()->positions;
    CHECK(document->surface()->report.contact);
    recipe.occluders[0].transform.translate = Vec3(0, -1.35, 0);
    document->change(recipe, "Move ball", s.work);
    CHECK(document->surface()->positions == pulled);
    CHECK(document->versions().edits_applied() == 1);
    check_as_forged(*document, s);
    recipe.edits[0].occluders.reset(); // those of the recipe, as they stand
    document->change(recipe, "Let go of the ball", s.work);
    CHECK(document->surface()->positions != pulled);
    check_as_forged(*document, s);
    const size_t applied = document->versions().edits_applied();
    recipe.occluders[0].shape = {SphereShape{0.31}};
    document->change(recipe, "Larger ball", s.work);
    CHECK(document->versions().edits_applied() == applied + 1);
    check_as_forged(*document, s);
}

TEST_CASE("a step that fails leaves everything as it was") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.edits.push_back(pull(Vec3(1, 0, 0), 0.1));
    document->change(recipe, "Pull", s.work);
    document->change(s.story(recipe).back(), "Story", s.work);
    document->undo(s.work);
    const DocumentState before = document->state();
    const auto check_unchanged = [&] {
        const DocumentState now = document->state();
        CHECK(now.recipe == before.recipe);
        CHECK(now.surface == before.surface);
        CHECK(now.undo == before.undo);
        CHECK(now.redo == before.redo);
    };
    Recipe bad = recipe;
    bad.edits[0].radius = -1;
    CHECK_THROWS_AS(document->change(bad, "Bad radius", s.work), InputError);
    check_unchanged();
    bad = recipe;
    bad.edits[0].handles[0].at = VertexAddress{1000000};
    CHECK_THROWS_AS(document->change(bad, "No such vertex", s.work), InputError);
    check_unchanged();
    bad = recipe;
    bad.edits[0].occluders = {{"nobody", {}, {}, {}}};
    CHECK_THROWS_AS(document->change(bad, "No such occluder", s.work), InputError);
    check_unchanged();
    Progress cancelled;
    cancelled.cancel();
    Recipe other = recipe;
    other.edits[0].radius = 0.3;
    const EditWork work{*s.backend, s.log, cancelled};
    CHECK_THROWS_AS(document->change(other, "Cancelled", work), Cancelled);
    check_unchanged();
    document->redo(s.work);
    document->undo(s.work);
    document->change(other, "Now", s.work);
    check_as_forged(*document, s);
}

TEST_CASE("steps of one slider are one step, until something else happens") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.edits.push_back(pull(Vec3(1, 0, 0), 0.1));
    document->change(recipe, "Pull", s.work);
    const std::vector<Vec3> pulled = document->surface()->positions;
    for (const double amount : {0.9, 0.8, 0.7}) {
        recipe.edits[0].amount = amount;
        document->change(recipe, "Amount", s.work, "amount 0");
    }
    check_as_forged(*document, s);
    recipe.edits[0].radius = 0.4;
    document->change(recipe, "Radius", s.work, "radius 0");
    document->undo(s.work);
    CHECK(document->recipe().edits[0].amount == 0.7);
    CHECK(document->state().undo == "Amount");
    document->undo(s.work);
    CHECK(document->surface()->positions == pulled);
    document->redo(s.work);
    document->redo(s.work);
    document->save_recipe(s.folder / "saved.json");
    recipe.edits[0].radius = 0.5;
    document->change(recipe, "Radius", s.work, "radius 0");
    document->undo(s.work);
    CHECK(document->recipe().edits[0].radius == 0.4);
    CHECK_FALSE(document->unsaved());
}

TEST_CASE("two hundred drags are undone within the budget, and none is made again") {
    Session s(2562);
    const auto probe = s.open();
    s.options.budget = 40 * own_bytes(*probe->surface()); // of 201 surfaces
    const auto document = s.open();
    const DragsAndBack seen = drag_and_undo(*document, s, 200);
    CHECK(seen.different == 0);
    CHECK(seen.most_bytes <= s.options.budget);
    CHECK(seen.most_bytes > s.options.budget / 2);
    CHECK(document->versions().edits_applied() == 200);
}

TEST_CASE("where not even what drags change fits the budget, they are made again and are what they were") {
    Session s(2562);
    const auto probe = s.open();
    s.options.budget = 8 * own_bytes(*probe->surface());
    const auto document = s.open();
    const DragsAndBack seen = drag_and_undo(*document, s, 60);
    CHECK(seen.different == 0);
    CHECK(seen.most_bytes <= s.options.budget);
    CHECK(document->versions().edits_applied() > 60);
    // Once for each piece of the history that fits, not for each step back: 60^2 / 2 of them.
    CHECK(document->versions().edits_applied() < 400);
}

TEST_CASE("another back end makes all surfaces anew, and none is mixed from two") {
    Session s;
    const auto document = s.open();
    std::vector<Vec3> first;
    for (const Recipe& next : s.story(document->recipe())) {
        document->change(next, "Step", s.work);
    }
    first = document->surface()->positions;
    const auto other = make_float_cpu_backend(false);
    const EditWork work{*other, s.log, s.progress};
    document->change_backend(work);
    CHECK(document->surface()->positions != first);
    check_as_forged(*document, s, *other);
    document->undo(work);
    check_as_forged(*document, s, *other);
    document->redo(s.work);
    CHECK(document->surface()->positions == first);
}

TEST_CASE(
    "an occluder that is switched off is one step that is undone and redone, and no edit or file sees it") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    for (const Recipe& next : s.story(recipe)) {
        document->change(next, "Step", s.work);
    }
    document->save_recipe(s.folder / "story.json");
    const std::vector<Vec3> before = document->surface()->positions;
    recipe = document->recipe();
    using Names = std::set<std::string>;

    document->switch_off({"ball", "unknown"}, "Switch");
    CHECK(document->state().off == Names{"ball"});
    CHECK(document->state().undo == "Switch");
    CHECK_FALSE(document->unsaved());
    CHECK(document->recipe() == recipe);
    CHECK(document->surface()->positions == before);

    document->switch_off({"ball"}, "Again"); // it is off: no step
    CHECK(document->state().undo == "Switch");
    recipe.edits.push_back(pull(Vec3(0, 0, 1), 0.1));
    document->change(recipe, "Pull", s.work);
    CHECK(document->state().off == Names{"ball"}); // what comes after keeps it
    document->undo(s.work);
    document->undo(s.work);
    CHECK(document->state().off.empty());
    CHECK(document->state().redo == "Switch");
    CHECK(document->surface()->positions == before);
    document->redo(s.work);
    CHECK(document->state().off == Names{"ball"});

    recipe = document->recipe();
    recipe.occluders[0].name = "other";
    for (Edit& edit : recipe.edits) {
        edit.occluders = std::vector<OccluderUse>{};
    }
    document->change(recipe, "Rename", s.work);
    CHECK(document->state().off.empty()); // another one of the name would not be off
    document->undo(s.work);
    CHECK(document->state().off == Names{"ball"});
}
