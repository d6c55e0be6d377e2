#include "engine/distance/numbering.h"

#include "engine/mesh/place_order.h"

#include <bit>
#include <numeric>

namespace anvil {
namespace {

std::vector<uint32_t> inverse(const std::vector<uint32_t>& order) {
    std::vector<uint32_t> place(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
    }
    return place;
}

std::vector<uint32_t> counted(size_t count) {
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

} // namespace

Numbering number_by_place(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
    Numbering numbering;
    numbering.mesh_vertex = order_by_place(positions);
    numbering.new_vertex = inverse(numbering.mesh_vertex);
    std::vector<uint32_t> first(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        first[t] = std::min({numbering.new_vertex[a], numbering.new_vertex[b], numbering.new_vertex[c]});
    }
    const auto last = static_cast<uint32_t>(std::bit_ceil(positions.size() + 1) - 1);
    numbering.new_triangle = inverse(sorted_by(counted(triangles.size()), first, 0, last));
    return numbering;
}

Numbering number_as_given(size_t triangles, size_t vertices) {
    return {counted(vertices), counted(vertices), counted(triangles)};
}

} // namespace anvil
