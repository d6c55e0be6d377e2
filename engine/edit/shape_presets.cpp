#include "engine/edit/shape_function.h"

#include "engine/core/error.h"

#include <array>
#include <utility>

namespace anvil {

namespace {

Knot smooth_knot(double t, double value, double slope) {
    return {t, value, slope, slope};
}

Knot kink(double t, double value, double left, double right) {
    return {t, value, left, right};
}

using Preset = std::pair<std::string, std::vector<Knot>>;

// The slopes of "sphere" sqrt(1 - t^2) and "root" 1 - sqrt(t) are exact at their knots (which lie on
// Pythagorean triples and squares), except at the vertical ends: there they are as steep as the last
// segment allows without overshoot.
const std::array<Preset, 10>& presets() {
    static const std::array<Preset, 10> list{{
        {"smooth", {smooth_knot(0, 1, 0), smooth_knot(1, 0, 0)}},
        {"linear", {smooth_knot(0, 1, -1), smooth_knot(1, 0, -1)}},
        {"sphere",
         {smooth_knot(0, 1, 0), smooth_knot(0.28, 0.96, -7.0 / 24), smooth_knot(0.6, 0.8, -0.75),
          smooth_knot(0.8, 0.6, -4.0 / 3), smooth_knot(0.96, 0.28, -24.0 / 7), smooth_knot(1, 0, -20)}},
        {"root",
         {smooth_knot(0, 1, -22), smooth_knot(1.0 / 64, 0.875, -4), smooth_knot(1.0 / 16, 0.75, -2),
          smooth_knot(0.25, 0.5, -1), smooth_knot(1, 0, -0.5)}},
        {"sharp", {smooth_knot(0, 1, -2), smooth_knot(1, 0, 0)}},
        {"plateau", {smooth_knot(0, 1, 0), kink(0.9, 1, 0, -10), smooth_knot(1, 0, -10)}},
        {"constant", {smooth_knot(0, 1, 0), kink(0.999, 1, 0, -1000), smooth_knot(1, 0, -1000)}},
        {"crater", {smooth_knot(0, 0.4, 0), smooth_knot(0.45, 1, 0), smooth_knot(1, 0, 0)}},
        {"wave",
         {smooth_knot(0, 1, 0), smooth_knot(0.25, -0.6, 0), smooth_knot(0.5, 0.35, 0),
          smooth_knot(0.75, -0.15, 0), smooth_knot(1, 0, 0)}},
        {"rim",
         {smooth_knot(0, 0.5, 0), kink(0.6, 0.5, 0, 2.5), kink(0.8, 1, 2.5, -5), smooth_knot(1, 0, -5)}},
    }};
    return list;
}

} // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
        names.push_back(preset.first);
    }
    return names;
}

std::string preset_list() {
    std::string list;
    for (const Preset& preset : presets()) {
        list += (list.empty() ? "" : ", ") + preset.first;
    }
    return list;
}

const std::vector<Knot>& preset_knots(const std::string& name) {
    for (const Preset& preset : presets()) {
        if (preset.first == name) {
            return preset.second;
        }
    }
    throw InputError("unknown shape \"" + name + "\"; known are " + preset_list() +
                     ", or give {\"knots\": [...]}");
}

} // namespace anvil
