#include "app/viewer/panels/curve_editor.h"
#include "app/viewer/panels/occluder_panel.h"

#include <catch2/catch.hpp>

using namespace anvil;

TEST_CASE("a knot that is added leaves the curve as it was, in every preset") {
    for (const std::string& name : preset_names()) {
        INFO(name);
        ShapeChoice shape = with_own_knots({name, {}});
        const ShapeFunction before = make_shape_function({name, {}});
        const size_t knots = shape.knots.size();
        const size_t index = add_knot(shape, 0.37);
        CHECK(shape.knots[index].t == Approx(0.37).margin(0.006));
        CHECK(shape.knots.size() - knots <= 1);
        const ShapeFunction after = make_shape_function(shape);
        double worst = 0;
        for (int i = 0; i <= 1000; ++i) {
            worst = std::max(worst, std::abs(after(i / 1000.0) - before(i / 1000.0)));
        }
        // A cubic with its value and slope at a place between is the same cubic; the slope comes from a
        // difference over 2e-6, which rounding makes uncertain by 1e-10.
        CHECK(worst <= 1e-4);
    }
}

TEST_CASE("knots stay between their neighbours, the last one ends the region, and the shape stays valid") {
    ShapeChoice shape = with_own_knots({"plateau", {}});
    add_knot(shape, 0.5);
    for (size_t i = 0; i < shape.knots.size(); ++i) {
        for (const double t : {-3.0, 0.1, 0.99, 7.0}) {
            move_knot(shape, i, t, 9.0);
            CHECK_NOTHROW(make_shape_function(shape));
        }
    }
    CHECK(shape.knots.back().value == 0);
    CHECK(std::abs(make_shape_function(shape)(1.0)) <= 1e-12);
    move_knot(shape, 1, std::nan(""), 0);
    CHECK_NOTHROW(make_shape_function(shape));
}

TEST_CASE("the first and the last knot cannot be removed") {
    ShapeChoice shape = with_own_knots({"smooth", {}});
    CHECK_FALSE(remove_knot(shape, 0));
    CHECK_FALSE(remove_knot(shape, shape.knots.size() - 1));
    const size_t index = add_knot(shape, 0.4);
    CHECK(remove_knot(shape, index));
    CHECK(shape == with_own_knots({"smooth", {}}));
}

TEST_CASE("a new occluder stands beside the mesh, with a name of its own") {
    Recipe recipe;
    Box scene;
    scene.include(Vec3(-1, -2, -3));
    scene.include(Vec3(1, 2, 3));
    for (const std::string& kind : occluder_kinds()) {
        for (int i = 0; i < 3; ++i) {
            const Occluder occluder = new_occluder(recipe, kind, scene);
            CHECK(find_occluder(recipe, occluder.name) == nullptr);
            if (kind != "plane") {
                CHECK(occluder.transform.translate.x - 0.15 * scene.diagonal() >= 1 - 1e-12);
            }
            recipe.occluders.push_back(occluder);
        }
    }
}
