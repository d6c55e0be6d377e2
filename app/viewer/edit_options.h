// What an edit is made with beside its handles: how occluders act in it. Which of them are on, the document
// says.
#pragma once

#include "engine/edit/recipe.h"

namespace anvil {

/// The same for the edit under way and the next ones until it is changed. Edits that were taken have what
/// they were taken with.
struct EditOptions {
    std::optional<Dilation> dilation;
    /// A hammer without handles acts within the radius around the place it strikes, not on the whole mesh.
    bool near_strike = false;
};

} // namespace anvil
