#include "tests/unit/edit/recipe_texts.h"

using namespace anvil;
using namespace anvil::recipe_texts;

TEST_CASE("vertex indices are whole numbers that 32 bits hold") {
    for (const char* bad : {"-1", "1.5", "4294967295", "1e20", "\"7\"", "true"}) {
        check_complaint(replaced(minimal(), R"("vertex": 0)", R"("vertex": )" + std::string(bad)),
                        {"handles[0].at.vertex", "whole number"});
    }
    CHECK(complaint(replaced(minimal(), R"("vertex": 0)", R"("vertex": 7.0)")).empty());
}

TEST_CASE("points on the surface are given in exactly one way") {
    const auto at = [](const std::string& point) {
        return with_handle(R"({"by": [0,0,0], "at": )" + point + "}");
    };
    check_complaint(at("{}"), {"handles[0].at", "exactly one", "\"nearest\""});
    check_complaint(at(R"({"vertex": 1, "nearest": [0,0,0]})"), {"exactly one"});
    check_complaint(at(R"({"vertex": 1, "triangle": 0})"), {"at.triangle", "unknown key"});
    check_complaint(at(R"({"face": 1, "barycentric": [0.5, 0.6, 0]})"),
                    {"barycentric", "0.5,0.6,0", "sum to 1"});
    check_complaint(at(R"({"face": 1, "barycentric": [-0.1, 0.6, 0.5]})"), {"barycentric", "negative"});
    check_complaint(at(R"({"face": 1})"), {"handles[0].at", "whole face", "barycentric"});
    check_complaint(at(R"({"polyline": [{"vertex": 9}]})"), {"handles[0].at", "polyline is an anchor"});
}

TEST_CASE("barycentrics within rounding of the triangle are accepted and brought to sum 1") {
    const Recipe recipe = parse(
        with_handle(R"({"at": {"face": 1, "barycentric": [-5e-10, 0.3333333, 0.6666667]}, "by": [0,0,0]})"));
    const auto& b = std::get<FaceAddress>(recipe.edits[0].handles[0].at).barycentric;
    CHECK(b[0] == 0);
    CHECK(b[0] + b[1] + b[2] == Approx(1).epsilon(1e-15));
    CHECK(parse(write_recipe(recipe)) == recipe);
}

TEST_CASE("a handle has one target that fits the kind of its edit") {
    const std::string at = R"("at": {"vertex": 1})";
    check_complaint(with_handle("{" + at + "}"), {"edits[0].handles[0]", "no target", "\"by\" or \"to\""});
    check_complaint(with_handle("{" + at + R"(, "by": [0,0,1], "to": [0,0,1]})"), {"both \"by\" and \"to\""});
    check_complaint(with_handle("{" + at + R"(, "degrees": 3})"), {"\"degrees\"", "translation", "\"by\""});
    check_complaint(with_handle("{" + at + R"(, "by": [0,0,1]})", "rotate"),
                    {"\"by\"", "rotation", "\"degrees\""});
    check_complaint(with_handle("{" + at + R"(, "degrees": 3, "to": [0,0,1]})", "rotate"),
                    {"both \"degrees\" and \"to\""});
    check_complaint(with_handle("{" + at + "}", "rotate"), {"no target", "\"degrees\" or \"to\""});
    check_complaint(with_handle("{" + at + R"(, "path": [[0,0,0], [1,0,0]], "degrees": 3})", "rotate"),
                    {"\"path\"", "rotation", "\"degrees\""});
}

TEST_CASE("a path has two offsets or more, and no other target beside it") {
    const std::string at = R"("at": {"vertex": 1})";
    const auto with_path = [&](const std::string& path) {
        return with_handle("{" + at + R"(, "path": )" + path + "}");
    };
    check_complaint(with_path("[[0,0,0]]"), {"handles[0].path", "list of 1", "at least two", "\"by\""});
    check_complaint(with_path("[]"), {"handles[0].path", "at least two"});
    check_complaint(with_path("[[0,0,0], [1,2]]"), {"handles[0].path[1]", "[1,2]", "three numbers"});
    check_complaint(with_path("[[0,0,0], [1e308,0,0]]"), {"handles[0].path", "longer"});
    check_complaint(with_path("[[0,0,0], [1e999,0,0]]"), {"handles[0].path[1]", "1e999", "finite"});
    check_complaint(with_handle("{" + at + R"(, "path": [[0,0,0], [1,0,0]], "by": [0,0,1]})"),
                    {"handles[0]", "both \"by\" and \"path\""});
    check_complaint(with_handle("{" + at + R"(, "path": [[0,0,0], [1,0,0]], "to": [0,0,1]})"),
                    {"both \"to\" and \"path\""});
    const Recipe recipe = parse(with_path("[[0,0,0], [0,-0.02,0], [0,-0.05,0.01]]"));
    CHECK(recipe.edits[0].handles[0].path ==
          std::vector<Vec3>{Vec3(0), Vec3(0, -0.02, 0), Vec3(0, -0.05, 0.01)});
    CHECK(parse(write_recipe(recipe)) == recipe);
}

TEST_CASE("lengths and fractions outside their range are refused") {
    for (const char* bad : {"0", "-0.5"}) {
        check_complaint(minimal(R"(, "radius": )" + std::string(bad)),
                        {"edits[0].radius", bad, "greater than 0"});
        check_complaint(
            with_handle(R"({"at": {"vertex": 1}, "by": [0,0,0], "radius": )" + std::string(bad) + "}"),
            {"handles[0].radius", "greater than 0"});
        check_complaint(with_shape(R"({"sphere": {"radius": )" + std::string(bad) + "}}"),
                        {"occluders[0].shape.sphere.radius", "greater than 0"});
        check_complaint(with_occluder(ball + R"(, "influence": {"kind": "soft", "sigma": )" + bad + "}"),
                        {"influence.sigma", "greater than 0"});
        check_complaint(with_occluder(ball + R"(, "transform": {"scale": )" + bad + "}"),
                        {"transform.scale", "greater than 0"});
    }
    check_complaint(minimal(R"(, "amount": 1.5)"), {"amount", "1.5", "[0, 1]"});
    check_complaint(minimal(R"(, "amount": -0.1)"), {"amount", "[0, 1]"});
    check_complaint(with_occluder(ball + R"(, "influence": {"strength": 1.1})"), {"strength", "[0, 1]"});
    for (const char* bad : {"0", "-1", "1000001", "2.5"}) {
        check_complaint(minimal(R"(, "steps": {"count": )" + std::string(bad) + "}"),
                        {"edits[0].steps.count", bad, "1000000"});
        check_complaint(minimal(R"(, "steps": {"max": )" + std::string(bad) + "}"), {"edits[0].steps.max"});
    }
    check_complaint(minimal(R"(, "steps": {})"), {"steps", "\"count\"", "\"max\""});
    check_complaint(minimal(R"(, "steps": {"count": 1, "max": 2})"), {"steps", "either"});
}

TEST_CASE("dilation has a form and either an amount or a volume to solve for") {
    const auto with_dilation = [](const std::string& text) { return minimal(R"(, "dilation": )" + text); };
    check_complaint(with_dilation("{}"), {"edits[0].dilation", "\"form\" is missing"});
    check_complaint(with_dilation(R"({"form": "deep"})"), {"dilation.form", "\"depth\"", "\"volume\""});
    check_complaint(with_dilation(R"({"form": "depth"})"), {"dilation", "either \"amount\""});
    check_complaint(with_dilation(R"({"form": "volume", "amount": 1, "solve": true})"),
                    {"either \"amount\""});
    check_complaint(with_dilation(R"({"form": "depth", "solve": true})"), {"dilation.solve", "volume"});
    check_complaint(with_dilation(R"({"form": "depth", "amount": -1})"), {"dilation.amount", "-1"});
    check_complaint(with_dilation(R"({"form": "depth", "amount": 1, "width": 0})"),
                    {"dilation.width", "greater than 0"});
    for (const char* good : {R"({"form": "depth", "amount": 0.5, "width": 2})",
                             R"({"form": "volume", "amount": 1})", R"({"form": "volume", "solve": true})"}) {
        const Recipe recipe = parse(with_dilation(good));
        CHECK(recipe.edits[0].dilation);
        CHECK(parse(write_recipe(recipe)) == recipe);
    }
}

TEST_CASE("rotations need their axis and translations have none") {
    const std::string rotate = R"({"anvil": 1, "mesh": "a", "edits": [{"kind": "rotate", AXIS
        "handles": [{"at": {"vertex": 7}, "degrees": 90}]}]})";
    check_complaint(replaced(rotate, "AXIS", ""), {"edits[0]", "rotation needs an \"axis\"", "direction"});
    check_complaint(replaced(rotate, "AXIS", R"("axis": {"origin": [0,0,0], "direction": [0,0,0]},)"),
                    {"edits[0].axis.direction", "zero"});
    check_complaint(replaced(rotate, "AXIS", R"("axis": {"direction": [0,1,0]},)"),
                    {"\"origin\" is missing"});
    check_complaint(minimal(R"(, "axis": {"origin": [0,0,0], "direction": [0,1,0]})"), {"axis", "rotation"});
    check_complaint(minimal(R"(, "sweep": "arc")"), {"sweep", "rotation"});
    check_complaint(with_occluder(ball + R"(, "transform": {"rotate": {"degrees": 30}})"),
                    {"occluders[0].transform.rotate", "axis"});
    check_complaint(with_occluder(ball + R"(, "transform": {"rotate": {"axis": [0,0,0], "degrees": 30}})"),
                    {"transform.rotate.axis", "zero"});
}

TEST_CASE("shape functions are checked where they stand") {
    check_complaint(minimal(R"(, "shape": "smoth")"), {"edits[0].shape", "smoth", "plateau", "crater"});
    for (const char* bad : {"5", "true", "[\"smooth\"]", "null"}) {
        check_complaint(minimal(R"(, "shape": )" + std::string(bad)),
                        {"edits[0].shape", "found", "smooth, linear", "rim", "knots"});
    }
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1}]})"),
                    {"edits[0].shape.knots", "2 to 256"});
    check_complaint(
        minimal(
            R"(, "shape": {"knots": [{"t": 0, "value": 1}, {"t": 0.6, "value": 1}, {"t": 0.5, "value": 0}]})"),
        {"edits[0].shape.knots[2].t", "must increase"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1}, {"t": 1, "value": 1}]})"),
                    {"edits[0].shape.knots[1].value", "jump", "must be 0"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0}]})"), {"knots[0]", "\"value\" is missing"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1, "tangent": 0, "left": 1}]})"),
                    {"knots[0]", "both sides"});
    check_complaint(with_handle(R"({"at": {"vertex": 1}, "by": [0,0,0], "shape": "x"})"),
                    {"edits[0].handles[0].shape", "known are"});
}

TEST_CASE("anchors name an existing handle, once") {
    check_complaint(minimal(R"(, "anchors": [{"handle": 1, "at": [{"vertex": 1}]}])"),
                    {"edits[0].anchors[0].handle", "found 1", "0 to 0"});
    check_complaint(minimal(R"(, "anchors": [{"handle": 0, "at": []}])"), {"anchors[0].at", "at least one"});
    check_complaint(
        minimal(R"(, "anchors": [{"handle": 0, "at": [{"vertex": 1}]}, {"at": [{"vertex": 2}]}])"),
        {"anchors[1]", "already"});
    const auto anchor = [](const std::string& at, const std::string& rest = "") {
        return minimal(R"(, "anchors": [{"at": [)" + at + "]" + rest + "}]");
    };
    check_complaint(anchor(R"({"vertx": 3})"), {"anchors[0].at[0].vertx", "\"vertex\"", "\"polyline\""});
    check_complaint(anchor(R"({"face": 3, "triangle": 0})"), {"anchors[0].at[0]", "barycentric"});
    check_complaint(anchor(R"({"vertex": 3, "polyline": []})"), {"anchors[0].at[0].vertex", "unknown key"});
    check_complaint(anchor(R"({"polyline": [{"vertex": 9}]})"), {"at[0].polyline", "two points"});
    check_complaint(anchor(R"({"polyline": {"vertex": 9}})"), {"at[0].polyline", "list"});
    check_complaint(anchor(R"({"polyline": [{"vertex": 9}, {"face": 2}]})"),
                    {"at[0].polyline[1]", "whole face", "barycentric"});
    check_complaint(anchor(R"({"vertex": 3})", R"(, "blend": "max")"),
                    {"anchors[0].blend", "found \"max\"", "\"min\"", "smooth"});
    check_complaint(anchor(R"({"vertex": 3})", R"(, "blend": 0.1)"),
                    {"anchors[0].blend", "{\"smooth\": width}"});
    check_complaint(anchor(R"({"vertex": 3})", R"(, "blend": {"smooth": 0})"),
                    {"anchors[0].blend.smooth", "found 0", "greater than 0"});
    check_complaint(anchor(R"({"vertex": 3})", R"(, "blend": {"width": 1})"),
                    {"anchors[0].blend.width", "\"smooth\""});
}

TEST_CASE("rounds of smoothing are whole, and refused where no distance runs over the surface") {
    for (const char* bad : {"-1", "1.5", "1001", "true"}) {
        check_complaint(minimal(R"(, "smooth_surface": )" + std::string(bad)),
                        {"edits[0].smooth_surface", bad, "0 to 1000"});
    }
    check_complaint(minimal(R"(, "smooth_surface": 5, "metric": "euclidean")"),
                    {"edits[0].smooth_surface", "Euclidean", "geodesic"});
    CHECK(complaint(minimal(R"(, "smooth_surface": 0, "metric": "euclidean")")).empty());
    CHECK(complaint(replaced(minimal(R"(, "smooth_surface": 5, "metric": "euclidean")"), R"("by")",
                             R"("metric": "geodesic", "by")"))
              .empty());
}
