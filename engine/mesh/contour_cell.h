// How a surface passes through one cell of a grid: the combinatorics of dual contouring.
#pragma once

#include <array>
#include <cstdint>

namespace anvil::contour {

/// Corner c of a cell has offsets (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + u + 2 v runs along axis a at
/// offset u in axis (a + 1) % 3 and v in axis (a + 2) % 3. Face 2 a + s is perpendicular to axis a at offset
/// s.
constexpr int edge_count = 12;
constexpr uint8_t no_sheet = 0xff;

constexpr int bit_of(int corner, int axis) {
    return corner >> axis & 1;
}

constexpr int edge_start(int edge) {
    const int axis = edge / 4;
    return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
}

constexpr int edge_of(int axis, int corner) {
    return 4 * axis + bit_of(corner, (axis + 1) % 3) + 2 * bit_of(corner, (axis + 2) % 3);
}

/// True if the surface crosses the edge; bit c of `inside` is set where corner c is inside.
constexpr bool crosses(uint8_t inside, int edge) {
    const int start = edge_start(edge);
    return (inside >> start & 1) != (inside >> (start | 1 << edge / 4) & 1);
}

/// The face's four corners in order around it; its edge k joins corners k and k + 1.
std::array<int, 4> face_corners(int face);
std::array<int, 4> face_edges(int face);

/// True if the inside and outside corners of a face alternate, so that its four crossings can be joined in
/// two ways.
bool is_ambiguous(uint8_t inside, int face);

/// The sheets (closed cycles of crossed edges) of a cell: each becomes one vertex.
struct Sheets {
    std::array<uint8_t, edge_count> of_edge; ///< sheet of each crossed edge, no_sheet elsewhere
    uint8_t count = 0;
};

/// An ambiguous face joins its crossings around the inside corners, around the outside ones if its bit in
/// `flipped` is set.
Sheets find_sheets(uint8_t inside, uint8_t flipped);

} // namespace anvil::contour
