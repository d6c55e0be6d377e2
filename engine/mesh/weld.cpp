#include "engine/mesh/weld.h"

#include <bit>

namespace anvil {

namespace {

// Round coordinates differ in their topmost bits only, the table's slot is the lowest: every bit has to reach
// all others. Multiplying carries bits up (the constant is 2^64 over the golden ratio), shifting brings them
// down.
uint64_t mix(uint64_t hash, uint64_t bits) {
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 32);
}

uint64_t hash_of(const Vec3& p) {
    uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        hash = mix(hash, std::bit_cast<uint64_t>(p[axis] + 0.0)); // -0 + 0 is 0
    }
    return mix(mix(hash, 0), 0);
}

} // namespace

std::vector<uint32_t> first_equal(std::span<const Vec3> positions) {
    // Open addressing, at most half full: one flat allocation, which node-based maps are slow without.
    const size_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
    std::vector<uint32_t> table(mask + 1, no_index);
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        const Vec3& p = positions[i];
        size_t slot = hash_of(p) & mask;
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
