// Numbers for some of a mesh's vertices, at a cost that the mesh's size has no part in.
#pragma once

#include "engine/core/types.h"

#include <vector>

namespace anvil {

class VertexNumbers {
  public:
    /// O(vertex_count), once.
    explicit VertexNumbers(size_t vertex_count) : numbers_(vertex_count, no_index) {}

    size_t vertex_count() const { return numbers_.size(); }

    /// no_index where none was given.
    uint32_t operator[](uint32_t vertex) const { return numbers_[vertex]; }

    /// The next number, from 0 on, to a vertex without one. @return whether it had none.
    bool add(uint32_t vertex) {
        if (numbers_[vertex] != no_index) {
            return false;
        }
        numbers_[vertex] = static_cast<uint32_t>(vertices_.size());
        vertices_.push_back(vertex);
        return true;
    }

    /// By number.
    const std::vector<uint32_t>& vertices() const { return vertices_; }

    /// O(numbers given).
    void clear() {
        for (const uint32_t v : vertices_) {
            numbers_[v] = no_index;
        }
        vertices_.clear();
    }

  private:
    std::vector<uint32_t> numbers_;
    std::vector<uint32_t> vertices_;
};

} // namespace anvil
