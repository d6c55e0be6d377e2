// Whether an edit can be trusted with a mouse.
#pragma once

#include <string>

namespace anvil {

/// Refuses edits whose handles can hardly be told apart with their shapes and radii, so that a small move
/// throws the surface far: an amplification above 1000, or a condition beyond which a pixel's rounding
/// shows. `place` begins the reason; empty: nothing does.
/// @throws InputError with what would mend it
void refuse_ill_conditioned(double condition, double amplification, const std::string& place = "");

} // namespace anvil
