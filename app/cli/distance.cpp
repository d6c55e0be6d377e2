#include "app/backend_choice.h"
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

struct Found {
    std::vector<double> distances; ///< one per vertex
    std::vector<Vec3> sources;
    std::string method; ///< that `auto` has chosen; of straight distances none
};

Found find_distances(const Mesh& mesh, const Options& options) {
    const RefinementHistory unrefined(mesh);
    KeptSolvers solvers;
    SurfaceState surface(mesh, mesh.positions, unrefined, solvers);
    Found found;
    DistanceQuery query;
    query.anchors.emplace_back();
    for (const std::string& text : options.from) {
        const SurfacePoint point = surface.resolve(parse_address(text), "--from " + text);
        query.anchors[0].points.push_back(point);
        found.sources.push_back(surface.position_of(point));
    }
    query.metric = options.metric == "euclidean" ? Metric::euclidean : Metric::geodesic;
    query.method = method_named(options.method);
    query.radius = options.radius.value_or(infinity);
    const DistanceField field = std::move(surface.distances({&query, 1})[0]);
    found.distances = field.dense(mesh.vertex_count());
    if (query.metric == Metric::geodesic) {
        found.method = field.method == DistanceMethod::exact ? " (exact)" : " (approximate)";
    }
    return found;
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

void draw(const Mesh& mesh, const Found& found, const Options& options) {
    const auto device = std::make_shared<Device>();
    draw_distances(*device, mesh, found.distances, found.sources, options.picture);
    check_validation(device);
    const double farthest = farthest_of(found.distances);
    const std::string lines =
        farthest > 0 ? "isolines every " + number_text(isoline_spacing(farthest)) + ", " : "";
    write_text("", lines + "farthest " + rounded_text(farthest) + found.method + " -> " +
                       options.picture.path + "\n");
}

void run(const Options& options, CommandContext& context) {
    check(options);
    const Mesh mesh = read_mesh(options.mesh, context.log);
    context.progress.report("distance", 0);
    const Found found = find_distances(mesh, options);
    context.progress.report("distance", 1);
    if (options.picture.wanted()) {
        draw(mesh, found, options);
    }
    if (!options.output.empty() || !options.picture.wanted()) {
        write_text(options.output, lines_of(found.distances));
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
