#include "app/viewer/part_size.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr uint64_t least = 10'000;           // each part has its price too
constexpr uint64_t most = uint64_t{1} << 40; // far more than any scene
constexpr double most_change = 4; // one part may have been out of sight, or met other work on the machine

} // namespace

void PartSize::took(uint64_t size, double milliseconds) {
    if (size == 0) {
        return;
    }
    const double factor = milliseconds > 0
                              ? std::clamp(wanted_milliseconds / milliseconds, 1 / most_change, most_change)
                              : most_change;
    const auto fits =
        static_cast<uint64_t>(std::min(factor * static_cast<double>(size), static_cast<double>(most)));
    // A small scene says little of how a larger one would do.
    next_ = factor > 1 ? std::max(next_, fits) : fits;
    next_ = std::clamp(next_, least, most);
}

} // namespace anvil
