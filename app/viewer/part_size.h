// How much of a surface is drawn at a time.
#pragma once

#include <cstdint>

namespace anvil {

/// Learns from how long parts took how large the next may be.
class PartSize {
  public:
    static constexpr double wanted_milliseconds = 35; ///< of a part, what is drawn beside it included

    uint64_t next() const { return next_; } ///< triangles and lines
    void took(uint64_t size, double milliseconds);

  private:
    uint64_t next_ = 20'000; ///< before anything is known
};

} // namespace anvil
