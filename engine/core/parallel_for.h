// One way to use all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace anvil {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on all cores; exceptions reach the
/// caller. Ranges hold at least `grain` items, so that small work stays on one thread.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

} // namespace anvil
