#include "engine/document/surface_difference.h"

#include "engine/core/error.h"

#include <algorithm>
#include <array>
#include <bit>

namespace anvil {

namespace {

constexpr size_t bytes_each = sizeof(uint32_t) + 2 * (sizeof(Vec3) + sizeof(VertexState));

using Bits = std::array<uint64_t, 3>;

bool same_at(const SurfaceVersion& a, const SurfaceVersion& b, size_t v) {
    // Bits, not values: zeros of both signs are equal, and what is no number is not.
    return std::bit_cast<Bits>(a.positions[v]) == std::bit_cast<Bits>(b.positions[v]) &&
           a.weights[v] == b.weights[v] && a.moved[v] == b.moved[v] && a.touching[v] == b.touching[v];
}

VertexState state_at(const SurfaceVersion& surface, size_t v) {
    return {surface.weights[v], surface.moved[v], surface.touching[v]};
}

/// All but the vectors over vertices.
SurfaceVersion rest_of(const SurfaceVersion& surface) {
    SurfaceVersion rest;
    rest.file = surface.file;
    rest.mesh = surface.mesh;
    rest.history = surface.history;
    rest.frame = surface.frame;
    rest.volume = surface.volume;
    rest.number = surface.number;
    rest.report = surface.report;
    rest.seconds = surface.seconds;
    rest.warnings = surface.warnings;
    return rest;
}

/// `surface` becomes the one that `rest` is of, where the vertices have these values.
void become(const SurfaceVersion& rest, const std::vector<uint32_t>& vertices,
            const std::vector<Vec3>& positions, const std::vector<VertexState>& states,
            SurfaceVersion& surface) {
    SurfaceVersion next = rest_of(rest);
    next.positions = std::move(surface.positions);
    next.weights = std::move(surface.weights);
    next.moved = std::move(surface.moved);
    next.touching = std::move(surface.touching);
    const size_t count = next.mesh->vertex_count();
    next.positions.resize(count);
    next.weights.resize(count);
    next.moved.resize(count);
    next.touching.resize(count);
    for (size_t i = 0; i < positions.size(); ++i) {
        const uint32_t v = vertices[i];
        next.positions[v] = positions[i];
        next.weights[v] = states[i].weight;
        next.moved[v] = states[i].moved;
        next.touching[v] = states[i].touching;
    }
    surface = std::move(next);
}

std::vector<uint32_t> vertices_that_differ(const SurfaceVersion& before, const SurfaceVersion& after) {
    const size_t known = before.positions.size();
    std::vector<uint32_t> vertices;
    for (size_t v = 0; v < after.positions.size(); ++v) {
        if (v >= known || !same_at(before, after, v)) {
            vertices.push_back(static_cast<uint32_t>(v));
        }
    }
    vertices.shrink_to_fit();
    return vertices;
}

} // namespace

std::optional<SurfaceDifference> difference(const SurfaceVersion& before, const SurfaceVersion& after) {
    const size_t known = before.positions.size();
    if (after.positions.size() < known) {
        throw InternalError("an edit took vertices away");
    }
    SurfaceDifference change;
    change.vertices = vertices_that_differ(before, after);
    const size_t count = change.vertices.size();
    if (count * bytes_each > own_bytes(after) * 3 / 4) {
        return std::nullopt;
    }
    change.new_positions.reserve(count);
    change.new_states.reserve(count);
    const auto fresh = static_cast<size_t>(
        change.vertices.end() - std::lower_bound(change.vertices.begin(), change.vertices.end(), known));
    change.old_positions.reserve(count - fresh);
    change.old_states.reserve(count - fresh);
    for (const uint32_t v : change.vertices) {
        change.new_positions.push_back(after.positions[v]);
        change.new_states.push_back(state_at(after, v));
        if (v < known) {
            change.old_positions.push_back(before.positions[v]);
            change.old_states.push_back(state_at(before, v));
        }
    }
    change.before = std::make_shared<const SurfaceVersion>(rest_of(before));
    change.after = std::make_shared<const SurfaceVersion>(rest_of(after));
    return change;
}

void apply(const SurfaceDifference& change, SurfaceVersion& surface) {
    become(*change.after, change.vertices, change.new_positions, change.new_states, surface);
}

void take_back(const SurfaceDifference& change, SurfaceVersion& surface) {
    become(*change.before, change.vertices, change.old_positions, change.old_states, surface);
}

size_t own_bytes(const SurfaceDifference& change) {
    return sizeof change + own_bytes(*change.before) + own_bytes(*change.after) +
           change.vertices.capacity() * sizeof(uint32_t) +
           (change.old_positions.capacity() + change.new_positions.capacity()) * sizeof(Vec3) +
           (change.old_states.capacity() + change.new_states.capacity()) * sizeof(VertexState);
}

} // namespace anvil
