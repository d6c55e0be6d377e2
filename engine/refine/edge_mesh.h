// Triangles with numbered edges that are split in conforming rounds.
#pragma once

#include "engine/core/types.h"

#include <functional>
#include <span>
#include <vector>

namespace anvil {

/// Flat arrays, not half-edges: edges may have any number of triangles, and splitting needs to know no more
/// than which edges a triangle has. An edge that was split stays as a hole. Edges from a vertex to itself
/// have no number.
class EdgeMesh {
  public:
    struct Edge {
        uint32_t a = 0;
        uint32_t b = 0;
        uint32_t middle = no_index; ///< the vertex that split it
        uint32_t halves = no_index; ///< the edge a - middle; the next one is middle - b
    };
    struct Face {
        Triangle corners;
        Triangle edges; ///< edge i runs between corners i and i + 1
        uint32_t root;  ///< the triangle that it came from, as numbered in `all`
    };

    /// Numbers the edges of the triangles `chosen` of `all`. Vertices are those of `all`, below
    /// `vertex_count`.
    EdgeMesh(std::span<const Triangle> all, std::span<const uint32_t> chosen, size_t vertex_count);

    const std::vector<Edge>& edges() const { return edges_; }
    const std::vector<Face>& faces() const { return faces_; }
    bool is_split(uint32_t edge) const { return edges_[edge].middle != no_index; }

    /// Marks a whole edge as split by a vertex; split() then divides its faces.
    void mark(uint32_t edge, uint32_t middle);

    /// Whether a quad of a face with two split edges should get the diagonal first - third in place of
    /// second - fourth.
    using Diagonal = std::function<bool(uint32_t first, uint32_t second, uint32_t third, uint32_t fourth)>;

    /// Divides those of `candidates` (all others have no split edge) into 2, 3 or 4 and returns the faces
    /// that are new or changed. New edges follow in edges().
    std::vector<uint32_t> split(std::span<const uint32_t> candidates, const Diagonal& first_diagonal);

  private:
    uint32_t new_edge(uint32_t a, uint32_t b);
    uint32_t half_at(uint32_t edge, uint32_t end) const;
    void put(uint32_t slot, const Triangle& corners, const Triangle& edges, uint32_t root);
    void split_one(uint32_t face, int at);
    void split_two(uint32_t face, int whole, const Diagonal& first_diagonal);
    void split_three(uint32_t face);

    std::vector<Edge> edges_;
    std::vector<Face> faces_;
};

} // namespace anvil
