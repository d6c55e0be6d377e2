// Kinks of shape functions that matter for the tolerance: lines of equal distance that become edges.
#pragma once

#include "engine/refine/edge_error.h"

#include <memory>
#include <span>

namespace anvil {

struct RefineState;

/// Numbers the levels of all handles; a crease is a level that was raised. The handles must outlive it.
class Creases {
  public:
    explicit Creases(const std::vector<HandleField>& handles);

    /// Makes a level a crease; appends it to `fresh` if it was none.
    void raise(uint32_t handle, uint32_t level, std::vector<uint32_t>& fresh);
    bool empty() const { return raised_.empty(); }

    struct Crossing {
        uint32_t crease = no_index;
        double place = 0;   ///< in (0, 1)
        bool is_on = false; ///< the crease is there; else the edge crosses it close to both ends, and `place`
                            ///< is between
    };
    /// Per edge: the crossing with a crease that lies farthest from both ends; none if all lie so close to an
    /// end that the end counts as on the crease. Chords of a crease that is steep on one side cross it close
    /// to both ends: cut there, they would be walked along in small steps; cut between, they are halved.
    std::vector<Crossing> cross(const RefineState& state, std::span<const EdgeSpan> edges) const;

    /// Sets labels[v] for the vertices that count as on the creases of `fresh`.
    void label(const RefineState& state, std::span<const uint32_t> fresh,
               std::vector<uint32_t>& labels) const;

  private:
    struct Level {
        uint32_t handle;
        uint32_t level;
        double distance;
        bool raised;
    };
    std::vector<Level> levels_;
    std::vector<uint32_t> first_; ///< per handle: its first level
    std::vector<uint32_t> raised_;
};

} // namespace anvil
