#include "app/cli/backend_choice.h"
#include "app/cli/command.h"
#include "app/cli/distance_picture.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/forge/surface_state.h"
#include "engine/mesh/mesh_reader.h"

#include <memory>
#include <optional>

namespace anvil {

namespace {

struct Options {
    std::string mesh;
    std::vector<std::string> from;
    std::optional<double> radius;
    std::string metric = "geodesic";
    std::string method = "auto";
    std::string output;
    PictureOptions picture;
};

void check(const Options& options) {
    if (options.radius && !(*options.radius > 0)) {
        throw InputError("--radius: found " + number_text(*options.radius) +
                         "; give a length greater than 0");
    }
    check_picture_name(options.picture.path);
    if (options.picture.wanted()) {
        options.picture.size();
        options.picture.view();
    }
}

DistanceMethod method_named(const std::string& name) {
    if (name == "exact") {
        return DistanceMethod::exact;
    }
    return name == "approximate" ? DistanceMethod::approximate : DistanceMethod::automatic;
}

std::vector<double> find_distances(const Mesh& mesh, const Options& options) {
    const RefinementHistory unrefined(mesh);
    SurfaceState surface(mesh, mesh.positions, unrefined);
    std::vector<SurfacePoint> sources;
    for (const std::string& text : options.from) {
        sources.push_back(surface.resolve(parse_address(text), "--from " + text));
    }
    const Metric metric = options.metric == "euclidean" ? Metric::euclidean : Metric::geodesic;
    return surface.distances(sources, metric, method_named(options.method), options.radius.value_or(infinity))
        .dense(mesh.vertex_count());
}

/// One per line: every double reads back as itself.
std::string lines_of(const std::vector<double>& numbers) {
    std::string text;
    text.reserve(numbers.size() * 20);
    for (const double x : numbers) {
        append_17_digits(text, x);
        text += '\n';
    }
    return text;
}

void run(const Options& options, CommandContext& context) {
    check(options);
    const Mesh mesh = read_mesh(options.mesh, context.log);
    context.progress.report("distance", 0);
    const std::vector<double> distances = find_distances(mesh, options);
    context.progress.report("distance", 1);
    if (!options.picture.wanted()) {
        write_text(options.output, lines_of(distances));
        return;
    }
    const auto device = std::make_shared<Device>();
    draw_distances(*device, mesh, distances, options.picture);
    check_validation(device);
    if (!options.output.empty()) {
        write_text(options.output, lines_of(distances));
    }
}

} // namespace

void add_distance(Program& program, CommandContext& context) {
    auto options = std::make_shared<Options>();
    Command command =
        program.add_command("distance", "Distance of every vertex from points of the surface, one per line",
                            "anvil distance hand.ply --from v:1082 --radius 0.2 -o distances.txt");
    command.positional("mesh", options->mesh, "Mesh file: .obj, .ply, .stl, .off");
    command.repeated(
        "--from", options->from,
        "v:INDEX, f:FACE[.TRIANGLE]:b0,b1,b2, or x,y,z (the nearest surface point); may be repeated");
    command.number("--radius", options->radius, "No farther than this; inf beyond");
    command.choice("--metric", options->metric, {"geodesic", "euclidean"},
                   "Along the surface, or straight through space");
    command.choice("--method", options->method, {"auto", "approximate", "exact"},
                   "How geodesic distances are found");
    command.option("-o,--output", options->output, "Text file in place of standard output");
    add_picture_options(command, options->picture);
    command.run([options, &context] { run(*options, context); });
}

} // namespace anvil
