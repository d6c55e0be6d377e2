#include "engine/forge/forge.h"
#include "app/backend_choice.h"
#include "app/cli/command.h"
#include "app/cli/forge_picture.h"
#include "app/cli/picture_options.h"
#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/document/recipe_paths.h"
#include "engine/edit/recipe_json.h"
#include "engine/mesh/mesh_format.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace anvil {

namespace {

namespace fs = std::filesystem;

struct ForgeArguments {
    std::string recipe;
    std::string out;
    std::string mesh;
    std::string device = "auto";
    std::string bake = "auto";
    std::string precision = "auto";
    PictureOptions picture;
    std::string report;
    std::string parents;
    std::string delta;
    bool dry_run = false;
    bool quiet = false;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

OutputPrecision output_precision(const std::string& name) {
    if (name == "float") {
        return OutputPrecision::single_precision;
    }
    return name == "double" ? OutputPrecision::double_precision : OutputPrecision::automatic;
}

ChosenBackend chosen_backend(const ForgeArguments& arguments, Log& log) {
    const DeviceBaking baking = device_baking(arguments.bake);
    ChosenBackend chosen = choose_backend(arguments.device, log, baking);
    check_baking(baking, chosen.device != nullptr);
    return chosen;
}

bool is_text(const fs::path& path) {
    return path.extension() == ".txt";
}

/// Refuses before any work what would destroy an input or one output with another.
void check_outputs(const ForgeArguments& arguments, const fs::path& mesh, const fs::path& out) {
    mesh_format(out); // refuses what could not be written
    check_picture_name(arguments.picture.path);
    const std::vector<std::pair<std::string, fs::path>> outputs{{"-o", out},
                                                                {"--image", arguments.picture.path},
                                                                {"--report", arguments.report},
                                                                {"--parents", arguments.parents},
                                                                {"--delta", arguments.delta}};
    for (size_t i = 0; i < outputs.size(); ++i) {
        if (outputs[i].second.empty()) {
            continue;
        }
        for (const fs::path& input : {mesh, fs::path(arguments.recipe)}) {
            if (same_file(outputs[i].second, input)) {
                throw InputError(outputs[i].first + " " + outputs[i].second.string() +
                                 " would overwrite the input; name another file");
            }
        }
        for (size_t j = 0; j < i; ++j) {
            if (!outputs[j].second.empty() && same_file(outputs[i].second, outputs[j].second)) {
                throw InputError(outputs[i].first + " and " + outputs[j].first + " name the same file " +
                                 outputs[i].second.string() + "; name two");
            }
        }
    }
    if (!arguments.delta.empty() && !is_text(arguments.delta)) {
        mesh_format(arguments.delta);
    }
}

fs::path default_output(const std::string& recipe) {
    fs::path path = recipe;
    path.replace_extension(".forged.ply");
    return path;
}

/// One line for a person: what moved, what was added, where it went.
std::string summary(const ForgeResult& result, const fs::path& out) {
    const auto moved = std::count(result.moved.begin(), result.moved.end(), true);
    const size_t edits = result.report.edits.size();
    const size_t added = result.parents.size();
    return "forged " + std::to_string(edits) + (edits == 1 ? " edit: " : " edits: ") + std::to_string(moved) +
           " of " + std::to_string(result.report.vertices) + " vertices moved" +
           (added > 0 ? ", " + std::to_string(added) + " added" : "") + ", on " + result.report.device +
           " -> " + out.string() + "\n";
}

/// What refinement would add, edit by edit.
std::string dry_summary(const ForgeResult& result) {
    std::string text;
    for (size_t i = 0; i < result.report.edits.size(); ++i) {
        const auto& refine = result.report.edits[i].refine;
        text += "edits[" + std::to_string(i) + "]: " +
                (refine ? std::to_string(refine->added) + " vertices would be added"
                        : std::string("does not refine")) +
                "\n";
    }
    return text;
}

/// A line for each new vertex, in order: its parents and the place from the first (0) to the second (1).
std::string parents_text(const ForgeResult& result) {
    std::string text;
    for (const VertexParents& p : result.parents) {
        text += std::to_string(p.a) + " " + std::to_string(p.b) + " " + number_text(p.place) + "\n";
    }
    return text;
}

/// The file's vertices as the edits leave them, with the file's faces: a blend shape; or as text, a line
/// `dx dy dz` for each.
void write_delta(const fs::path& path, const Mesh& mesh, const ForgeResult& result,
                 OutputPrecision precision) {
    const std::span<const Vec3> ends(result.positions.data(), mesh.vertex_count());
    if (!is_text(path)) {
        const std::vector<bool> moved(result.moved.begin(),
                                      result.moved.begin() + static_cast<std::ptrdiff_t>(ends.size()));
        write_edited_mesh(path, mesh, ends, moved, precision);
        return;
    }
    std::string text;
    for (size_t v = 0; v < ends.size(); ++v) {
        const Vec3 d = ends[v] - mesh.positions[v];
        text += number_text(d.x) + " " + number_text(d.y) + " " + number_text(d.z) + "\n";
    }
    write_text(path, text);
}

void run_forge(const ForgeArguments& arguments, CommandContext& context) {
    using Clock = std::chrono::steady_clock;
    const PictureView view = arguments.picture.view();
    const PictureSize size = arguments.picture.size();
    const Recipe recipe = read_recipe(arguments.recipe);
    const fs::path mesh_file = arguments.mesh.empty() ? mesh_path(recipe) : fs::path(arguments.mesh);
    const fs::path out = arguments.out.empty() ? default_output(arguments.recipe) : fs::path(arguments.out);
    check_outputs(arguments, mesh_file, out);

    const auto load_start = Clock::now();
    const Mesh mesh = read_mesh(mesh_file, context.log);
    const double load_seconds = seconds_since(load_start);
    const ChosenBackend chosen = chosen_backend(arguments, context.log);
    const std::optional<FileCache> cache = user_cache();
    ForgeResult result =
        forge(mesh, recipe, *chosen.backend, context.log, context.progress, cache ? &*cache : nullptr);
    result.report.seconds.load = load_seconds;

    const Mesh& final_mesh = result.refined ? *result.refined : mesh;
    Picture picture;
    if (arguments.picture.wanted()) {
        const auto device = chosen.device ? chosen.device : std::make_shared<Device>();
        picture = forge_picture(*device, final_mesh, recipe, result, view, size, context.progress);
        check_validation(device);
    }
    check_validation(chosen.device);
    const auto write_start = Clock::now();
    const OutputPrecision precision = output_precision(arguments.precision);
    if (!arguments.delta.empty()) {
        write_delta(arguments.delta, mesh, result, precision);
    }
    if (!arguments.dry_run) {
        write_edited_mesh(out, final_mesh, result.positions, result.moved, precision);
    }
    if (arguments.picture.wanted()) {
        write_png(arguments.picture.path, picture);
    }
    if (!arguments.parents.empty()) {
        write_text(arguments.parents, parents_text(result));
    }
    result.report.seconds.write = seconds_since(write_start);
    if (!arguments.report.empty()) {
        write_text(arguments.report, report_json(result.report));
    }
    if (!arguments.quiet) {
        write_text("", arguments.dry_run ? dry_summary(result) : summary(result, out));
    }
}

} // namespace

void add_forge(Program& program, CommandContext& context) {
    auto a = std::make_shared<ForgeArguments>();
    Command command =
        program.add_command("forge", "Apply a recipe's edits to its mesh",
                            "anvil forge grip.json -o grip.ply --image grip.png --report grip.report.json");
    command.positional("recipe", a->recipe, "Recipe file (JSON)");
    command.option("-o,--output", a->out, "Mesh to write (default: the recipe's name with .forged.ply)");
    command.option("--mesh", a->mesh, "Mesh to use in place of the recipe's");
    command.option("--device", a->device, "auto, cpu (double precision), a device's name or index");
    command.choice("--bake", a->bake, {"auto", "cpu", "device"},
                   "Where distance fields are baked; auto: on the device if that is a GPU");
    command.choice("--precision", a->precision, {"auto", "float", "double"},
                   "Numbers of the written mesh; auto: as the input needs");
    add_picture_options(command, a->picture);
    command.option("--report", a->report, "Report to write (JSON)");
    command.option("--parents", a->parents,
                   "Text file to write: the two parents and the place between them of each new vertex");
    command.option("--delta", a->delta,
                   "Blend shape to write: the file's own vertices and faces as the edits leave them, or "
                   "(.txt) their displacements");
    command.flag("--dry-run", a->dry_run, "Write no mesh; say how many vertices refinement adds");
    command.flag("--quiet", a->quiet, "Print warnings and errors only");
    command.run([a, &context] { run_forge(*a, context); });
}

} // namespace anvil
