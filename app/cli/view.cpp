#include "app/cli/command.h"
#include "app/viewer/viewer.h"

#include <memory>

namespace anvil {

void add_view(Program& program, CommandContext&) {
    auto options = std::make_shared<ViewerOptions>();
    Command command = program.add_command("view", "Open a mesh or recipe in a window", "anvil view hand.ply");
    command.optional_positional("file", options->file, "Mesh or recipe (JSON) to open");
    command.option("--script", options->script, "Play the events of this file, then leave");
    command.option("--screenshot", options->screenshot,
                   "PNG of the window at the script's end, or of the first picture, then leave");
    command.option("--device", options->device, "What deforms: auto, cpu, a device's name or index");
    command.choice("--bake", options->bake, {"auto", "cpu", "device"},
                   "Where distance fields are baked; auto: on the device if that is a GPU");
    command.run([options] { run_viewer(*options); });
}

} // namespace anvil
