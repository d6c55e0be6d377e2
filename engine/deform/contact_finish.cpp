#include "engine/deform/contact_finish.h"

#include "engine/core/parallel_for.h"
#include "engine/occluder/occluder_motion.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

namespace anvil {

namespace {

constexpr double reported_depth = 1e-6;   // of the occluder's size
constexpr double contact_distance = 1e-3; // of the occluder's size

/// What counts as touching, for the nearest occluder's exact distance: the least of all.
double touching(const OccluderSet& set) {
    double distance = infinity;
    for (size_t k = 0; k < set.occluders.size(); ++k) {
        distance = std::min(distance, touching_distance(set, k));
    }
    return distance;
}

struct Nearest {
    double distance; ///< exact
    double size;     ///< of the occluder
    double settle;   ///< how far off its surface contact sets vertices down
};

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

/// The start as the occluder nearest to the end sees it.
Vec3 carried_start(const OccluderSet& before, const OccluderSet& set, const Vec3& start, const Vec3& end) {
    if (!before.moves()) {
        return start;
    }
    size_t nearest = 0;
    double least = infinity;
    for (size_t k = 0; k < set.occluders.size(); ++k) {
        const double distance = exact_distance(set, k, end).distance;
        if (distance < least) {
            least = distance;
            nearest = k;
        }
    }
    return carried(before.occluders[nearest], set.occluders[nearest], start);
}

Vec3 outside(const OccluderSet& before, const OccluderSet& set, const Vec3& start, const Vec3& end,
             double rounding) {
    Vec3 p = end;
    for (int i = 0; i < 16; ++i) {
        const SignedDistance s = exact_distance(set, p);
        if (s.distance >= -rounding) {
            return p;
        }
        p -= s.distance * s.normal;
    }
    return retreat(set, carried_start(before, set, start, end), end);
}

/// How near occluder k counts as contact.
double reach_of_contact(const OccluderSet& set, size_t occluder) {
    return set.occluders[occluder].settle + contact_distance * set.sizes[occluder];
}

struct Dip {
    double depth = 0;
    bool reported = false;        ///< deeper than rounding
    std::vector<size_t> touching; ///< occluders, ascending
};

/// Whether a corner is so far out that nothing of the triangle is near an occluder.
bool certified(const OccluderSet& set, const std::array<Vec3, 3>& corner) {
    double contact = 0;
    for (size_t k = 0; k < set.occluders.size(); ++k) {
        contact = std::max(contact, reach_of_contact(set, k));
    }
    for (size_t i = 0; i < 3; ++i) {
        const double reach = std::max(glm::length(corner[(i + 1) % 3] - corner[i]),
                                      glm::length(corner[(i + 2) % 3] - corner[i]));
        if (exact_distance(set, corner[i]).distance >= reach + contact) {
            return true;
        }
    }
    return false;
}

/// Deepest of 15 points of a triangle, and what they touch.
Dip dip(const OccluderSet& set, const std::array<Vec3, 3>& corner) {
    Dip deepest;
    if (certified(set, corner)) {
        return deepest;
    }
    for (size_t k = 0; k < set.occluders.size(); ++k) {
        double least = infinity;
        for (int u = 0; u <= 4; ++u) {
            for (int v = 0; u + v <= 4; ++v) {
                const Vec3 p =
                    corner[2] + 0.25 * u * (corner[0] - corner[2]) + 0.25 * v * (corner[1] - corner[2]);
                least = std::min(least, exact_distance(set, k, p).distance);
            }
        }
        deepest.depth = std::max(deepest.depth, -least);
        deepest.reported = deepest.reported || -least > reported_depth * set.sizes[k];
        if (least <= reach_of_contact(set, k)) {
            deepest.touching.push_back(k);
        }
    }
    return deepest;
}

void append(ContactReport& report, const ContactReport& part, std::vector<uint32_t> OccluderContact::*list) {
    for (size_t k = 0; k < part.occluders.size(); ++k) {
        const std::vector<uint32_t>& found = part.occluders[k].*list;
        (report.occluders[k].*list).insert((report.occluders[k].*list).end(), found.begin(), found.end());
    }
}

/// Threads find what touches in any order.
void sort_contacts(ContactReport& report, std::vector<uint32_t> OccluderContact::*list) {
    for (OccluderContact& occluder : report.occluders) {
        std::sort((occluder.*list).begin(), (occluder.*list).end());
    }
}

} // namespace

size_t finish_contact(const OccluderSet& set, std::span<const Vec3> starts, const std::vector<bool>& inside,
                      std::span<Vec3> ends) {
    const OccluderSet last = at_end(set);
    const double rounding = touching(last);
    std::atomic<size_t> moved{0};
    parallel_for(ends.size(), 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (!inside[i] && (set.moves() || ends[i] != starts[i]) &&
                exact_distance(last, ends[i]).distance < -rounding) {
                ends[i] = outside(set, last, starts[i], ends[i], rounding);
                ++moved;
            }
        }
    });
    return moved;
}

void measure_vertices(const OccluderSet& set, std::span<const Vec3> ends, const std::vector<bool>& inside,
                      ContactReport& report) {
    report.occluders.resize(set.occluders.size());
    std::mutex mutex;
    parallel_for(ends.size(), 512, [&](size_t begin, size_t end) {
        ContactReport part;
        part.occluders.resize(set.occluders.size());
        for (size_t i = begin; i < end; ++i) {
            Nearest nearest{infinity, 0, 0};
            for (size_t k = 0; k < set.occluders.size(); ++k) {
                const double distance = exact_distance(set, k, ends[i]).distance;
                if (distance < nearest.distance) {
                    nearest = {distance, set.sizes[k], set.occluders[k].settle};
                }
                if (distance <= reach_of_contact(set, k)) {
                    part.occluders[k].points.push_back(static_cast<uint32_t>(i));
                }
            }
            const double depth = inside[i] ? 0 : -nearest.distance;
            part.max_penetration = std::max(part.max_penetration, depth);
            part.penetrating_vertices += depth > reported_depth * nearest.size ? 1 : 0;
            part.contact_vertices +=
                std::abs(nearest.distance) <= nearest.settle + contact_distance * nearest.size ? 1 : 0;
        }
        const std::lock_guard lock(mutex);
        report.penetrating_vertices += part.penetrating_vertices;
        report.contact_vertices += part.contact_vertices;
        report.max_penetration = std::max(report.max_penetration, part.max_penetration);
        append(report, part, &OccluderContact::points);
    });
    sort_contacts(report, &OccluderContact::points);
}

void measure_triangles(const OccluderSet& set, std::span<const Vec3> positions, const Vec3& origin,
                       std::span<const Triangle> triangles, ContactReport& report) {
    report.occluders.resize(set.occluders.size());
    std::mutex mutex;
    parallel_for(triangles.size(), 256, [&](size_t begin, size_t end) {
        ContactReport part;
        part.occluders.resize(set.occluders.size());
        for (size_t i = begin; i < end; ++i) {
            const Triangle& t = triangles[i];
            const Dip found =
                dip(set, {positions[t[0]] - origin, positions[t[1]] - origin, positions[t[2]] - origin});
            part.deepest_dip = std::max(part.deepest_dip, found.depth);
            part.penetrating_triangles += found.reported ? 1 : 0;
            for (const size_t k : found.touching) {
                part.occluders[k].triangles.push_back(static_cast<uint32_t>(i));
            }
        }
        const std::lock_guard lock(mutex);
        report.penetrating_triangles += part.penetrating_triangles;
        report.deepest_dip = std::max(report.deepest_dip, part.deepest_dip);
        append(report, part, &OccluderContact::triangles);
    });
    sort_contacts(report, &OccluderContact::triangles);
}

} // namespace anvil
