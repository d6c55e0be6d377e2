#include "engine/mesh/place_order.h"

#include "engine/core/parallel_for.h"

#include <numeric>

namespace anvil {
namespace {

constexpr int bits_an_axis = 10;
constexpr uint32_t cells = 1U << bits_an_axis;

/// The bits of x (10) with two zeros between each two.
uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000FF;
    x = (x | x << 8) & 0x0300F00F;
    x = (x | x << 4) & 0x030C30C3;
    return (x | x << 2) & 0x09249249;
}

std::vector<uint32_t> morton_codes(std::span<const Vec3> positions) {
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    std::vector<uint32_t> codes(positions.size());
    const Vec3 extent = box.high - box.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0) || !std::isfinite(longest)) {
        return codes;
    }
    parallel_for(positions.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            const Vec3 cell = (positions[v] - box.low) / longest * static_cast<double>(cells);
            const auto at = [](double c) { return spread(std::min(static_cast<uint32_t>(c), cells - 1)); };
            codes[v] = at(cell.x) << 2 | at(cell.y) << 1 | at(cell.z);
        }
    });
    return codes;
}

} // namespace

std::vector<uint32_t> sorted_by(const std::vector<uint32_t>& items, const std::vector<uint32_t>& keys,
                                int shift, uint32_t mask) {
    std::vector<uint32_t> place(static_cast<size_t>(mask) + 2);
    for (const uint32_t item : items) {
        ++place[(keys[item] >> shift & mask) + 1];
    }
    std::partial_sum(place.begin(), place.end(), place.begin());
    std::vector<uint32_t> sorted(items.size());
    for (const uint32_t item : items) {
        sorted[place[keys[item] >> shift & mask]++] = item;
    }
    return sorted;
}

std::vector<uint32_t> order_by_place(std::span<const Vec3> points) {
    const std::vector<uint32_t> codes = morton_codes(points);
    std::vector<uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    for (int shift = 0; shift < 3 * bits_an_axis; shift += bits_an_axis) {
        order = sorted_by(order, codes, shift, cells - 1);
    }
    return order;
}

} // namespace anvil
