#include "engine/mesh/contour_cell.h"

namespace anvil::contour {

std::array<int, 4> face_corners(int face) {
    const int axis = face / 2;
    const int base = (face & 1) << axis;
    const int u = 1 << (axis + 1) % 3;
    const int v = 1 << (axis + 2) % 3;
    return {base, base | u, base | u | v, base | v};
}

std::array<int, 4> face_edges(int face) {
    const std::array<int, 4> corners = face_corners(face);
    const int u = (face / 2 + 1) % 3;
    const int v = (face / 2 + 2) % 3;
    return {edge_of(u, corners[0]), edge_of(v, corners[1]), edge_of(u, corners[3]), edge_of(v, corners[0])};
}

bool is_ambiguous(uint8_t inside, int face) {
    const std::array<int, 4> c = face_corners(face);
    const auto in = [&](int k) { return inside >> c[k] & 1; };
    return in(0) == in(2) && in(1) == in(3) && in(0) != in(1);
}

namespace {

using Labels = std::array<uint8_t, edge_count>;

void join(Labels& labels, int a, int b) {
    const uint8_t from = labels[b];
    const uint8_t to = labels[a];
    for (uint8_t& label : labels) {
        label = label == from ? to : label;
    }
}

void join_on_face(Labels& labels, uint8_t inside, int face, bool flipped) {
    const std::array<int, 4> edges = face_edges(face);
    if (is_ambiguous(inside, face)) {
        const std::array<int, 4> corners = face_corners(face);
        for (int k = 0; k < 4; ++k) {
            if (((inside >> corners[k] & 1) != 0) != flipped) {
                join(labels, edges[k], edges[(k + 3) % 4]);
            }
        }
        return;
    }
    int first = -1;
    for (const int edge : edges) {
        if (crosses(inside, edge)) {
            if (first >= 0) {
                join(labels, first, edge);
            }
            first = edge;
        }
    }
}

} // namespace

Sheets find_sheets(uint8_t inside, uint8_t flipped) {
    Labels labels;
    for (int e = 0; e < edge_count; ++e) {
        labels[e] = static_cast<uint8_t>(e);
    }
    for (int face = 0; face < 6; ++face) {
        join_on_face(labels, inside, face, flipped >> face & 1);
    }
    Sheets sheets;
    sheets.of_edge.fill(no_sheet);
    Labels number;
    number.fill(no_sheet);
    for (int e = 0; e < edge_count; ++e) {
        if (crosses(inside, e)) {
            uint8_t& sheet = number[labels[e]];
            sheet = sheet == no_sheet ? sheets.count++ : sheet;
            sheets.of_edge[e] = sheet;
        }
    }
    return sheets;
}

} // namespace anvil::contour
