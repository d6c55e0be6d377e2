// Which vertices of the surface are selected, and which are hidden.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/refine/refined_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anvil {

enum class SelectMode : uint8_t { replace, add, subtract };

/// A face with all corners hidden is neither drawn nor picked. What is hidden is never selected. O(mesh).
class Selection {
  public:
    size_t vertex_count() const { return marks_.size(); }
    bool selected(size_t vertex) const { return (marks_[vertex] & selected_bit) != 0; }
    bool hidden(size_t vertex) const { return (marks_[vertex] & hidden_bit) != 0; }
    size_t selected_count() const { return count(selected_bit); }
    size_t hidden_count() const { return count(hidden_bit); }
    /// Ascending.
    std::vector<uint32_t> selected_vertices() const;
    bool hides(std::span<const uint32_t> corners) const;
    /// Whether all corners are selected.
    bool selects(std::span<const uint32_t> corners) const;

    /// Goes over to another state of the same file's mesh with `count` vertices, those from `first` on added
    /// by refinement. Vertices keep what they are by their numbers; added ones that were not there before are
    /// as both their parents are, else neither selected nor hidden. `before`: the parents of the state so
    /// far.
    void follow(size_t count, std::span<const VertexParents> before, std::span<const VertexParents> now);
    /// Nothing is selected or hidden any more.
    void reset(size_t count) { marks_.assign(count, 0); }

    void change(std::span<const uint32_t> vertices, SelectMode mode);
    void select_all();
    void select_none();
    void invert();
    /// All corners of faces that have one selected; the other way round all but these of faces that have one
    /// that is not.
    void grow(const Mesh& mesh);
    void shrink(const Mesh& mesh);
    void hide_selected();
    void hide_unselected(); ///< the selection stays
    void show_all();        ///< what was hidden is selected then

    bool operator==(const Selection&) const = default;

  private:
    static constexpr uint8_t selected_bit = 1;
    static constexpr uint8_t hidden_bit = 2;

    size_t count(uint8_t bit) const;
    void spread(const Mesh& mesh, bool from_selected);

    std::vector<uint8_t> marks_;
};

} // namespace anvil
