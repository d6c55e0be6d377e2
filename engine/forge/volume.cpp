#include "engine/forge/volume.h"

namespace anvil {

namespace {

/// A bijection of 64-bit words without structure (splitmix64's finalizer, public domain).
uint64_t scattered(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

} // namespace

bool is_closed(const Mesh& mesh) {
    // A sum of scattered edge words in which every edge cancels against its reverse is zero, and by chance
    // otherwise once in 2^64.
    uint64_t sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const uint64_t a = t[i];
            const uint64_t b = t[(i + 1) % 3];
            sum += scattered(a << 32 | b) - scattered(b << 32 | a);
        }
    }
    return sum == 0 && !mesh.triangles.empty();
}

double enclosed_volume(const Mesh& mesh, std::span<const Vec3> positions) {
    const Vec3 origin = positions.empty() ? Vec3(0) : positions[0]; // far from zero, sums would cancel
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += glm::dot(positions[t[0]] - origin,
                        glm::cross(positions[t[1]] - origin, positions[t[2]] - origin));
    }
    return sum / 6;
}

} // namespace anvil
