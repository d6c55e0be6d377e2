#include "app/viewer/conditioning.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"

namespace anvil {

namespace {

constexpr double worst_condition = 1e6; ///< beyond, the last digit of a mouse's place shows
constexpr double most_amplification = 1000;

} // namespace

void refuse_ill_conditioned(double condition, double amplification, const std::string& place) {
    if (condition <= worst_condition && amplification <= most_amplification) {
        return;
    }
    throw InputError((place.empty() ? "" : place + ": ") +
                     "the handles can hardly be told apart with this shape and radius (condition " +
                     rounded_text(condition) + ", amplification " + rounded_text(amplification) +
                     "), small moves would throw the surface far; move them apart, use a smaller radius or a "
                     "steeper curve");
}

} // namespace anvil
