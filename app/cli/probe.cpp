#include "app/cli/command.h"
#include "engine/core/decimal.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/core/parallel_for.h"
#include "engine/core/read_file.h"
#include "engine/edit/recipe_json.h"
#include "engine/occluder/occluder_set.h"

#include <memory>
#include <string_view>

namespace anvil {

namespace {

struct Options {
    std::string recipe;
    std::string points;
    std::string output;
};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Takes a number off the front of `text`; false if there is none.
bool take_number(std::string_view& text, double& value) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    const char* end = parse_number(text.data(), text.data() + text.size(), value);
    const bool found = end != text.data();
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return found && (text.empty() || is_blank(text.front()));
}

Vec3 parse_point(std::string_view line, const std::string& place) {
    std::string_view rest = line;
    Vec3 p;
    bool good = take_number(rest, p.x) && take_number(rest, p.y) && take_number(rest, p.z) && is_finite(p);
    while (!rest.empty() && is_blank(rest.front())) {
        rest.remove_prefix(1);
    }
    good = good && rest.empty();
    if (!good) {
        throw InputError(place + ": found \"" + std::string(line.substr(0, 60)) +
                         "\"; a point is three finite numbers: x y z");
    }
    return p;
}

std::vector<Vec3> read_points(const std::string& file) {
    const std::string text = read_file(file);
    std::vector<Vec3> points;
    std::string_view rest = text;
    for (size_t number = 1; !rest.empty(); ++number) {
        const size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
            points.push_back(parse_point(line, file + ", line " + std::to_string(number)));
        }
    }
    return points;
}

/// The recipe's occluders at their own poses, by formula: what forge samples is an approximation of it.
OccluderSet build_occluders(const Recipe& recipe, Progress& progress) {
    if (recipe.occluders.empty()) {
        throw InputError(recipe.file + ": has no occluders to probe; add \"occluders\"");
    }
    OccluderSet set;
    for (size_t i = 0; i < recipe.occluders.size(); ++i) {
        const Occluder& occluder = recipe.occluders[i];
        try {
            const OccluderModel model =
                build_model(occluder.shape, Field{}, progress, {recipe_folder(recipe), nullptr});
            add_occluder(set, model, occluder.name, occluder.transform, occluder.influence, {Vec3(0), 1, 1});
        } catch (const InputError& error) {
            throw InputError(recipe.file + ": occluders[" + std::to_string(i) + "] \"" + occluder.name +
                             "\": " + error.what());
        }
    }
    return set;
}

void append(std::string& text, double x, char after) {
    append_17_digits(text, x);
    text += after;
}

std::string probe(const OccluderSet& occluders, const std::vector<Vec3>& points) {
    std::vector<SignedDistance> found(points.size());
    parallel_for(points.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            found[i] = exact_distance(occluders, points[i]);
        }
    });
    std::string text;
    text.reserve(found.size() * 80);
    for (const SignedDistance& at : found) {
        append(text, at.distance, ' ');
        append(text, at.normal.x, ' ');
        append(text, at.normal.y, ' ');
        append(text, at.normal.z, '\n');
    }
    return text;
}

} // namespace

void add_probe(Program& program, CommandContext& context) {
    auto options = std::make_shared<Options>();
    Command command = program.add_command(
        "probe",
        "Signed distance (negative inside) and outward normal of a recipe's nearest occluder at points",
        "anvil probe grip.json points.txt -o distances.txt");
    command.positional("recipe", options->recipe, "Recipe file (JSON)");
    command.positional("points", options->points, "Text file, a point x y z a line");
    command.option("-o,--output", options->output, "Text file in place of standard output");
    command.run([options, &context] {
        const Recipe recipe = read_recipe(options->recipe);
        const std::vector<Vec3> points = read_points(options->points);
        write_text(options->output, probe(build_occluders(recipe, context.progress), points));
    });
}

} // namespace anvil
