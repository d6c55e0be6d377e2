#include "engine/core/parallel_for.h"

#include <algorithm>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace anvil {

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    if (count <= grain) {
        if (count > 0) {
            body(0, count);
        }
        return;
    }
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, std::max<size_t>(grain, 1)),
                      [&](const tbb::blocked_range<size_t>& range) { body(range.begin(), range.end()); });
}

} // namespace anvil
