#include "engine/forge/forge.h"
#include "app/cli/backend_choice.h"
#include "app/cli/command.h"
#include "app/cli/forge_picture.h"
#include "app/cli/picture_options.h"
#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"
#include "engine/mesh/mesh_format.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/normals.h"

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

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) ||
           fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

/// Refuses before any work what would destroy an input or one output with another.
void check_outputs(const ForgeArguments& arguments, const fs::path& mesh, const fs::path& out) {
    mesh_format(out); // refuses what could not be written
    check_picture_name(arguments.picture.path);
    const std::vector<std::pair<std::string, fs::path>> outputs{
        {"-o", out}, {"--image", arguments.picture.path}, {"--report", arguments.report}};
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
    if (!arguments.parents.empty() || !arguments.delta.empty() || arguments.dry_run) {
        throw InputError("--parents, --delta and --dry-run come with adaptive refinement: not yet");
    }
}

fs::path default_output(const std::string& recipe) {
    fs::path path = recipe;
    path.replace_extension(".forged.ply");
    return path;
}

/// One line for a person: what moved, where it went.
std::string summary(const ForgeResult& result, const fs::path& out) {
    size_t moved = 0;
    for (const bool m : result.moved) {
        moved += m ? 1 : 0;
    }
    std::string text = "forged " + std::to_string(result.report.edits.size()) +
                       (result.report.edits.size() == 1 ? " edit: " : " edits: ") + std::to_string(moved) +
                       " of " + std::to_string(result.report.vertices) + " vertices moved, on " +
                       result.report.device + " -> " + out.string() + "\n";
    return text;
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
    Mesh mesh = read_mesh(mesh_file, context.log);
    const double load_seconds = seconds_since(load_start);
    const ChosenBackend chosen = choose_backend(arguments.device, context.log);
    ForgeResult result = forge(mesh, recipe, *chosen.backend, context.log, context.progress);
    result.report.seconds.load = load_seconds;

    Picture picture;
    if (arguments.picture.wanted()) {
        const auto device = chosen.device ? chosen.device : std::make_shared<Device>();
        picture = forge_picture(*device, mesh, recipe, result, view, size, context.progress);
        check_validation(device);
    }
    check_validation(chosen.device);
    const auto write_start = Clock::now();
    update_normals(mesh, result.positions, result.moved);
    write_mesh(out, mesh, result.positions, output_precision(arguments.precision));
    if (arguments.picture.wanted()) {
        write_png(arguments.picture.path, picture);
    }
    result.report.seconds.write = seconds_since(write_start);
    if (!arguments.report.empty()) {
        write_text(arguments.report, report_json(result.report));
    }
    if (!arguments.quiet) {
        write_text("", summary(result, out));
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
    command.choice("--precision", a->precision, {"auto", "float", "double"},
                   "Numbers of the written mesh; auto: as the input needs");
    add_picture_options(command, a->picture);
    command.option("--report", a->report, "Report to write (JSON)");
    command.option("--parents", a->parents, "Origin of refined vertices (not yet)");
    command.option("--delta", a->delta, "Blend shape of the original vertices (not yet)");
    command.flag("--dry-run", a->dry_run, "Say what refinement would add (not yet)");
    command.flag("--quiet", a->quiet, "Print warnings and errors only");
    command.run([a, &context] { run_forge(*a, context); });
}

} // namespace anvil
