#include "engine/refine/creases.h"

#include "engine/core/parallel_for.h"
#include "engine/refine/adaptive_refinement.h"

namespace anvil {

namespace {

// In radii: nearer than this a vertex is on the crease.
constexpr double on_crease = 5e-7;
// Crossings nearer to both ends than this share of the edge are those of a chord.
constexpr double at_ends = 0.1;

} // namespace

Creases::Creases(const std::vector<HandleField>& handles) {
    for (uint32_t h = 0; h < handles.size(); ++h) {
        first_.push_back(static_cast<uint32_t>(levels_.size()));
        const std::vector<ShapeLevel> levels = shape_levels(handles[h]);
        for (uint32_t i = 0; i < levels.size(); ++i) {
            levels_.push_back({h, i, levels[i].distance, false});
        }
    }
}

void Creases::raise(uint32_t handle, uint32_t level, std::vector<uint32_t>& fresh) {
    const uint32_t crease = first_[handle] + level;
    if (!levels_[crease].raised) {
        levels_[crease].raised = true;
        raised_.push_back(crease);
        fresh.push_back(crease);
    }
}

std::vector<Creases::Crossing> Creases::cross(const RefineState& state,
                                              std::span<const EdgeSpan> edges) const {
    std::vector<Crossing> crossings(edges.size());
    parallel_for(edges.size(), 1024, [&](size_t begin, size_t end) {
        std::vector<EdgeMeasure> measures(state.handles.begin(), state.handles.end());
        for (size_t i = begin; i < end; ++i) {
            double farthest = 0;
            for (const uint32_t crease : raised_) {
                const Level& level = levels_[crease];
                const double margin = on_crease * state.handles[level.handle].radius / edges[i].length;
                const std::vector<double>& places = measures[level.handle].crossings(edges[i], level.level);
                const bool is_chord = places.size() > 1 && places.front() > margin &&
                                      places.front() < at_ends && places.back() > 1 - at_ends &&
                                      places.back() < 1 - margin;
                for (const double place : places) {
                    const double from_end = std::min(place, 1 - place);
                    if (from_end > std::max(margin, farthest)) {
                        farthest = from_end;
                        crossings[i] =
                            is_chord ? Crossing{crease, 0.5, false} : Crossing{crease, place, true};
                    }
                }
            }
        }
    });
    return crossings;
}

void Creases::label(const RefineState& state, std::span<const uint32_t> fresh,
                    std::vector<uint32_t>& labels) const {
    labels.resize(state.positions.size(), no_index);
    for (const uint32_t crease : fresh) {
        const Level& level = levels_[crease];
        const HandleField& handle = state.handles[level.handle];
        for (uint32_t v = 0; v < labels.size(); ++v) {
            if (std::abs(handle.distance(v) - level.distance) <= on_crease * handle.radius) {
                labels[v] = crease;
            }
        }
    }
}

} // namespace anvil
