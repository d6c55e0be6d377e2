#include "engine/mesh/weld.h"

#include <bit>

namespace anvil {

namespace {

uint64_t mix(uint64_t hash, double value) {
    // Adding 0 turns -0 into 0. The constant is 2^64 over the golden ratio.
    hash = (hash ^ std::bit_cast<uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 29);
}

} // namespace

std::vector<uint32_t> first_equal(std::span<const Vec3> positions) {
    // Open addressing, at most half full: one flat allocation, which node-based maps are slow without.
    const size_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
    std::vector<uint32_t> table(mask + 1, no_index);
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        size_t slot = mix(mix(mix(0, p.x), p.y), p.z) & mask;
        while (table[slot] != no_index && positions[table[slot]] != p) {
            slot = (slot + 1) & mask;
        }
        if (table[slot] == no_index) {
            table[slot] = static_cast<uint32_t>(i);
        }
        first[i] = table[slot];
    }
    return first;
}

} // namespace anvil
