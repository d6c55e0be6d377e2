#include "engine/deform/contact_finish.h"

#include "engine/core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace anvil {

namespace {

/// Depth that is reported as penetration: 1e-6 of the smallest occluder's size.
double reported_depth(const OccluderSet& set) {
    double depth = infinity;
    for (size_t k = 0; k < set.occluders.size(); ++k) {
        depth = std::min(depth, 1e3 * touching_distance(set, k));
    }
    return depth;
}

double least_touching_distance(const OccluderSet& set) {
    return 1e-3 * reported_depth(set);
}

/// The point of the segment from `end` back to `start` nearest to the end that is outside, to 2^-40 of it.
Vec3 retreat(const OccluderSet& set, const Vec3& start, const Vec3& end) {
    constexpr int samples = 64;
    double out = 0; // outside at start + out (end - start)
    for (int i = samples - 1; i > 0; --i) {
        const double t = static_cast<double>(i) / samples;
        if (exact_distance(set, start + t * (end - start)).distance >= 0) {
            out = t;
            break;
        }
    }
    double in = out + 1.0 / samples;
    for (int i = 0; i < 40; ++i) {
        const double t = 0.5 * (out + in);
        (exact_distance(set, start + t * (end - start)).distance >= 0 ? out : in) = t;
    }
    return start + out * (end - start);
}

Vec3 outside(const OccluderSet& set, const Vec3& start, const Vec3& end, double rounding) {
    Vec3 p = end;
    for (int i = 0; i < 16; ++i) {
        const SignedDistance s = exact_distance(set, p);
        if (s.distance >= -rounding) {
            return p;
        }
        p -= s.distance * s.normal;
    }
    return retreat(set, start, end);
}

/// Deepest of 15 points of a triangle, or 0 where a corner certifies that all of it is outside.
double dip(const OccluderSet& set, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 corner[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        const double reach = std::max(glm::length(corner[(i + 1) % 3] - corner[i]),
                                      glm::length(corner[(i + 2) % 3] - corner[i]));
        if (exact_distance(set, corner[i]).distance >= reach) {
            return 0;
        }
    }
    double deepest = 0;
    for (int u = 0; u <= 4; ++u) {
        for (int v = 0; u + v <= 4; ++v) {
            const Vec3 p = c + 0.25 * u * (a - c) + 0.25 * v * (b - c);
            deepest = std::max(deepest, -exact_distance(set, p).distance);
        }
    }
    return deepest;
}

} // namespace

size_t finish_contact(const OccluderSet& set, std::span<const Vec3> starts, const std::vector<bool>& inside,
                      std::span<Vec3> ends) {
    const double rounding = least_touching_distance(set);
    std::atomic<size_t> moved{0};
    parallel_for(ends.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (!inside[i] && ends[i] != starts[i] && exact_distance(set, ends[i]).distance < -rounding) {
                ends[i] = outside(set, starts[i], ends[i], rounding);
                ++moved;
            }
        }
    });
    return moved;
}

void measure_vertices(const OccluderSet& set, std::span<const Vec3> ends, const std::vector<bool>& inside,
                      ContactReport& report) {
    const double limit = reported_depth(set);
    double near = 1e3 * limit;
    for (const auto& occluder : set.occluders) {
        near = std::max(near, 1e3 * limit + occluder.settle);
    }
    std::mutex mutex;
    parallel_for(ends.size(), 512, [&](size_t begin, size_t end) {
        size_t count = 0;
        size_t touching = 0;
        double deepest = 0;
        for (size_t i = begin; i < end; ++i) {
            const double distance = exact_distance(set, ends[i]).distance;
            const double depth = inside[i] ? 0 : -distance;
            deepest = std::max(deepest, depth);
            count += depth > limit ? 1 : 0;
            touching += std::abs(distance) <= near ? 1 : 0;
        }
        const std::lock_guard lock(mutex);
        report.penetrating_vertices += count;
        report.contact_vertices += touching;
        report.max_penetration = std::max(report.max_penetration, deepest);
    });
}

void measure_triangles(const OccluderSet& set, std::span<const Vec3> positions,
                       std::span<const Triangle> triangles, ContactReport& report) {
    const double limit = reported_depth(set);
    std::mutex mutex;
    parallel_for(triangles.size(), 256, [&](size_t begin, size_t end) {
        size_t count = 0;
        double deepest = 0;
        for (size_t i = begin; i < end; ++i) {
            const Triangle& t = triangles[i];
            const double depth = dip(set, positions[t[0]], positions[t[1]], positions[t[2]]);
            deepest = std::max(deepest, depth);
            count += depth > limit ? 1 : 0;
        }
        const std::lock_guard lock(mutex);
        report.penetrating_triangles += count;
        report.deepest_dip = std::max(report.deepest_dip, deepest);
    });
}

} // namespace anvil
