// A closed triangle surface whose edges can be split, collapsed and flipped.
#pragma once

#include "engine/mesh/mesh.h"

#include <span>
#include <vector>

namespace anvil {

/// Half-edges of a closed manifold: half-edge 3 f + k runs from corner k to corner k + 1 of face f. Every
/// operation keeps the surface closed and manifold. Deleted faces and vertices stay as holes until to_mesh().
class TriangleNet {
  public:
    /// @throws InputError if the triangles are not a closed, consistently oriented manifold.
    explicit TriangleNet(const Mesh& mesh);

    std::vector<Vec3> positions;

    uint32_t half_edge_count() const { return static_cast<uint32_t>(to_.size()); }
    uint32_t vertex_slots() const { return static_cast<uint32_t>(positions.size()); }
    size_t vertex_count() const { return vertex_count_; }
    size_t face_count() const { return face_count_; }

    bool is_alive(uint32_t half_edge) const { return to_[half_edge] != no_index; }
    bool has_vertex(uint32_t v) const { return leaving_[v] != no_index; }
    uint32_t from(uint32_t h) const { return to_[previous(h)]; }
    uint32_t to(uint32_t h) const { return to_[h]; }
    /// The corner opposite to the half-edge in its face.
    uint32_t apex(uint32_t h) const { return to_[next(h)]; }
    uint32_t twin(uint32_t h) const { return twin_[h]; }
    static uint32_t next(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static uint32_t previous(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

    /// Calls body(half_edge) for the half-edges that leave v, turning once around it.
    template <class Body>
    void around(uint32_t v, const Body& body) const {
        const uint32_t first = leaving_[v];
        uint32_t h = first;
        do {
            body(h);
            h = twin_[previous(h)];
        } while (h != first);
    }
    size_t degree(uint32_t v) const;
    bool are_neighbours(uint32_t a, uint32_t b) const;
    double edge_length(uint32_t h) const { return glm::distance(positions[from(h)], positions[to(h)]); }
    /// Twice the area along the unit normal.
    Vec3 face_normal(uint32_t h) const;

    /// New vertex at p in the middle of the edge; returns it.
    uint32_t split(uint32_t h, const Vec3& p);
    /// True if collapsing keeps the surface manifold.
    bool can_collapse(uint32_t h) const;
    /// Moves from(h) into to(h), which keeps its position; can_collapse(h) must hold.
    void collapse(uint32_t h);
    bool can_flip(uint32_t h) const;
    /// Joins the two corners opposite to the edge instead; can_flip(h) must hold.
    void flip(uint32_t h);
    /// Cuts every face into four at its edges' midpoints.
    void quarter();

    Mesh to_mesh() const;

  private:
    void connect(std::span<const Triangle> triangles);
    void pair_all();
    void set_face(uint32_t face, const Triangle& corners);
    void pair(uint32_t a, uint32_t b);
    uint32_t new_face();

    std::vector<uint32_t> to_;      ///< end vertex of each half-edge; no_index: deleted
    std::vector<uint32_t> twin_;    ///< the same edge in the neighbouring face
    std::vector<uint32_t> leaving_; ///< a half-edge from each vertex; no_index: deleted
    std::vector<uint32_t> free_faces_;
    size_t vertex_count_ = 0;
    size_t face_count_ = 0;
};

} // namespace anvil
