#include "app/bench/comparison.h"

#include "engine/core/number_text.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

CaseChange change_of(const BenchResult& before, const BenchResult& now) {
    CaseChange change{now.name, before.timing.median_s, now.timing.median_s, 1, {}};
    for (const auto& [yardstick, number] : now.ratios) {
        const auto same =
            std::find_if(before.ratios.begin(), before.ratios.end(),
                         [&name = yardstick](const auto& entry) { return entry.first == name; });
        if (same == before.ratios.end()) {
            continue;
        }
        const double by_this = number / same->second;
        if (change.yardstick.empty() || std::abs(std::log(by_this)) < std::abs(std::log(change.change))) {
            change.change = by_this;
            change.yardstick = yardstick;
        }
    }
    if (change.yardstick.empty()) {
        change.change = change.now_s / change.before_s;
    }
    return change;
}

std::string percent_text(double change) {
    const auto percent = static_cast<long>(std::lround(100 * (change - 1)));
    return (percent >= 0 ? "+" : "") + std::to_string(percent) + " %";
}

std::string line_of(const CaseChange& c) {
    return "  " + c.name + ": " + percent_text(c.change) + " by " +
           (c.yardstick.empty() ? "seconds" : "the yardstick " + c.yardstick) + " (" +
           rounded_text(1e3 * c.before_s) + " -> " + rounded_text(1e3 * c.now_s) + " ms)\n";
}

} // namespace

std::vector<CaseChange> changes_since(const BenchRun& before, const BenchRun& now) {
    std::vector<CaseChange> changes;
    for (const BenchResult& result : now.results) {
        const auto same = std::find_if(before.results.begin(), before.results.end(),
                                       [&](const BenchResult& r) { return r.name == result.name; });
        if (same != before.results.end()) {
            changes.push_back(change_of(*same, result));
        }
    }
    return changes;
}

std::string comparison_text(const std::vector<CaseChange>& changes) {
    std::string slower, faster, same;
    size_t slower_count = 0;
    for (const CaseChange& change : changes) {
        const bool is_slower = change.change > notable_change;
        slower_count += is_slower ? 1 : 0;
        (is_slower ? slower : change.change < 1 / notable_change ? faster : same) += line_of(change);
    }
    std::string text;
    for (const auto& [title, lines] :
         {std::pair{"about as before:\n", same}, {"faster:\n", faster}, {"SLOWER:\n", slower}}) {
        text += lines.empty() ? "" : title + lines;
    }
    return "\nsince the earlier run, by the yardstick that changes least:\n" + text +
           std::to_string(slower_count) + " of " + std::to_string(changes.size()) +
           " cases are slower by more than " + percent_text(notable_change).substr(1) + "\n";
}

} // namespace anvil
