#include "app/viewer/live_contact.h"

#include "engine/deform/contact_finish.h"

#include <algorithm>
#include <unordered_map>

namespace anvil {

namespace {

constexpr size_t most_marks = 3000; ///< more are no clearer

DeepPlace depth_at(const OccluderSet& set, const Vec3& origin, const Vec3& place) {
    return {place, -exact_distance(set, place - origin).distance};
}

std::vector<uint32_t> all_of(const ContactReport& report, std::vector<uint32_t> OccluderContact::*list) {
    std::vector<uint32_t> all;
    for (const OccluderContact& occluder : report.occluders) {
        const std::vector<uint32_t>& touching = occluder.*list;
        all.insert(all.end(), touching.begin(), touching.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

Vec3 centre_of(const std::array<Vec3, 3>& corners) {
    return (corners[0] + corners[1] + corners[2]) / 3.0;
}

double volume_under(const std::vector<Vec3>& places, const std::vector<Triangle>& triangles,
                    const Vec3& origin) {
    double sum = 0;
    for (const Triangle& t : triangles) {
        sum += glm::dot(places[t[0]] - origin, glm::cross(places[t[1]] - origin, places[t[2]] - origin)) / 6;
    }
    return sum;
}

} // namespace

ContactProbe::ContactProbe(std::span<const Triangle> triangles, const Incidence& incidence,
                           std::span<const Vec3> at_rest, std::span<const uint32_t> moving)
    : moving_(moving.size()) {
    std::unordered_map<uint32_t, uint32_t> numbers;
    const auto number_of = [&](uint32_t vertex) {
        const auto [entry, is_new] = numbers.try_emplace(vertex, static_cast<uint32_t>(at_rest_.size()));
        if (is_new) {
            at_rest_.push_back(at_rest[vertex]);
        }
        return entry->second;
    };
    std::vector<uint32_t> around;
    for (const uint32_t v : moving) {
        number_of(v);
        const auto at_vertex = incidence.at(v);
        around.insert(around.end(), at_vertex.begin(), at_vertex.end());
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const uint32_t index : around) {
        const Triangle& t = triangles[index];
        triangles_.push_back({number_of(t[0]), number_of(t[1]), number_of(t[2])});
    }
}

std::vector<Vec3> ContactProbe::places(std::span<const Vec3> ends) const {
    std::vector<Vec3> places = at_rest_;
    std::copy_n(ends.begin(), std::min(ends.size(), moving_), places.begin());
    return places;
}

double ContactProbe::volume_change(std::span<const Vec3> ends) const {
    if (at_rest_.empty()) {
        return 0;
    }
    const Vec3& origin = at_rest_.front(); // near the part: fewer digits are lost
    return volume_under(places(ends), triangles_, origin) - volume_under(at_rest_, triangles_, origin);
}

LiveContact ContactProbe::measure(const OccluderSet& set, const Vec3& origin,
                                  std::span<const Vec3> ends) const {
    LiveContact contact;
    if (set.empty()) {
        return contact;
    }
    const std::vector<Vec3> world = places(ends);
    std::vector<Vec3> local;
    local.reserve(moving_);
    for (size_t i = 0; i < moving_; ++i) {
        local.push_back(world[i] - origin);
    }
    ContactReport report;
    measure_vertices(set, local, std::vector<bool>(moving_, false), report);
    measure_triangles(set, world, origin, triangles_, report);
    const std::vector<uint32_t> vertices = all_of(report, &OccluderContact::points);
    const std::vector<uint32_t> triangles = all_of(report, &OccluderContact::triangles);
    contact.vertices = vertices.size();
    contact.triangles = triangles.size();
    for (const uint32_t v : vertices) {
        const DeepPlace place = depth_at(set, origin, world[v]);
        if (!contact.vertex || place.depth > contact.vertex->depth) {
            contact.vertex = place;
        }
        if (contact.marks.size() < most_marks) {
            contact.marks.push_back(world[v]);
        }
    }
    for (const uint32_t i : triangles) {
        const Triangle& t = triangles_[i];
        const std::array<Vec3, 3> corners{world[t[0]], world[t[1]], world[t[2]]};
        if (report.penetrating_triangles > 0) {
            ContactReport one;
            measure_triangles(set, world, origin, std::span(&t, 1), one);
            if (one.penetrating_triangles > 0 &&
                (!contact.triangle || one.deepest_dip > contact.triangle->depth)) {
                contact.triangle = DeepPlace{centre_of(corners), one.deepest_dip};
            }
        }
        if (contact.facets.size() < most_marks) {
            contact.facets.push_back(corners);
        }
    }
    return contact;
}

} // namespace anvil
