#include "engine/forge/volume.h"

namespace anvil {

namespace {

/// A bijection of 64-bit words without structure (splitmix64's finalizer, public domain).
uint64_t scattered(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Every directed edge is met by its reverse: a sum of scattered edge words in which each pair cancels is
/// zero (by chance otherwise once in 2^64), with no table over the edges.
bool closed(const Mesh& mesh) {
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

double volume(const Mesh& mesh, std::span<const Vec3> positions) {
    const Vec3 origin = positions.empty() ? Vec3(0) : positions[0];
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += glm::dot(positions[t[0]] - origin,
                        glm::cross(positions[t[1]] - origin, positions[t[2]] - origin));
    }
    return sum / 6;
}

} // namespace

std::optional<VolumeChange> volume_change(const Mesh& mesh, std::span<const Vec3> before,
                                          std::span<const Vec3> after) {
    if (!closed(mesh)) {
        return std::nullopt;
    }
    return VolumeChange{volume(mesh, before), volume(mesh, after)};
}

} // namespace anvil
