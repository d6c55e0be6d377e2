// Which cases have become slower since an earlier run.
#pragma once

#include "app/bench/bench_report.h"

#include <string>

namespace anvil {

/// Slower or faster by more than this counts.
inline constexpr double notable_change = 1.15;

struct CaseChange {
    std::string name;
    double before_s = 0;
    double now_s = 0;
    double change = 1;     ///< of the time, now over before, in terms of `yardstick`
    std::string yardstick; ///< empty: plain seconds
};

/// One entry for each case of `now` that `before` has too. Each of the yardsticks that both runs measured
/// gives a change: of the case's ratio to it, so that a machine that is slower as a whole changes nothing.
/// The one nearest to 1 counts: where a case has become slower, it is slower by any yardstick. Seconds count
/// where there is none.
std::vector<CaseChange> changes_since(const BenchRun& before, const BenchRun& now);

/// A table of the changes, the slower ones set apart, and one line that sums up.
std::string comparison_text(const std::vector<CaseChange>& changes);

} // namespace anvil
