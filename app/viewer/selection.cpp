#include "app/viewer/selection.h"

#include <algorithm>

namespace anvil {

namespace {

bool same(const VertexParents& a, const VertexParents& b) {
    return a.a == b.a && a.b == b.b && a.place == b.place;
}

} // namespace

size_t Selection::count(uint8_t bit) const {
    return static_cast<size_t>(
        std::count_if(marks_.begin(), marks_.end(), [&](uint8_t mark) { return (mark & bit) != 0; }));
}

std::vector<uint32_t> Selection::selected_vertices() const {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < marks_.size(); ++v) {
        if (selected(v)) {
            vertices.push_back(v);
        }
    }
    return vertices;
}

bool Selection::hides(std::span<const uint32_t> corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) { return hidden(v); });
}

bool Selection::selects(std::span<const uint32_t> corners) const {
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) { return selected(v); });
}

void Selection::follow(size_t count, std::span<const VertexParents> before,
                       std::span<const VertexParents> now) {
    const size_t first = count - now.size();
    const size_t known = first == marks_.size() - before.size() ? marks_.size() : 0;
    marks_.resize(std::min(known, count));
    marks_.resize(count, 0);
    for (size_t i = 0; i < now.size(); ++i) {
        if (i >= before.size() || !same(before[i], now[i])) {
            marks_[first + i] = marks_[now[i].a] & marks_[now[i].b];
        }
    }
}

void Selection::change(std::span<const uint32_t> vertices, SelectMode mode) {
    if (mode == SelectMode::replace) {
        select_none();
    }
    for (const uint32_t v : vertices) {
        if (hidden(v)) {
            continue;
        }
        marks_[v] = static_cast<uint8_t>(mode == SelectMode::subtract ? marks_[v] & ~selected_bit
                                                                      : marks_[v] | selected_bit);
    }
}

void Selection::select_all() {
    for (uint8_t& mark : marks_) {
        mark = (mark & hidden_bit) != 0 ? mark : mark | selected_bit;
    }
}

void Selection::select_none() {
    for (uint8_t& mark : marks_) {
        mark &= hidden_bit;
    }
}

void Selection::invert() {
    for (uint8_t& mark : marks_) {
        mark = (mark & hidden_bit) != 0 ? mark : mark ^ selected_bit;
    }
}

/// Faces that have a corner that is selected (or is not) take all their corners along.
void Selection::spread(const Mesh& mesh, bool from_selected) {
    std::vector<uint32_t> reached;
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        const std::span<const uint32_t> corners = mesh.polygon(f);
        const bool begins = std::any_of(corners.begin(), corners.end(), [&](uint32_t v) {
            return !hidden(v) && selected(v) == from_selected;
        });
        if (begins) {
            reached.insert(reached.end(), corners.begin(), corners.end());
        }
    }
    change(reached, from_selected ? SelectMode::add : SelectMode::subtract);
}

void Selection::grow(const Mesh& mesh) {
    spread(mesh, true);
}

void Selection::shrink(const Mesh& mesh) {
    spread(mesh, false);
}

void Selection::hide_selected() {
    for (uint8_t& mark : marks_) {
        mark = (mark & selected_bit) != 0 ? hidden_bit : mark;
    }
}

void Selection::hide_unselected() {
    for (uint8_t& mark : marks_) {
        mark = (mark & selected_bit) != 0 ? mark : hidden_bit;
    }
}

void Selection::show_all() {
    for (uint8_t& mark : marks_) {
        mark = (mark & hidden_bit) != 0 ? selected_bit : mark & selected_bit;
    }
}

} // namespace anvil
