#include "engine/distance/surface_tables.h"

#include "engine/core/parallel_for.h"
#include "engine/distance/row_table.h"

namespace anvil {
namespace {

/// A triangle that is not as it was, by the one that it came from.
struct NewTriangle {
    uint32_t root_slot, mesh_triangle;
};

/// The graph of the new surface out of the one before.
class GraphUpdate {
  public:
    GraphUpdate(SurfaceTables& tables, std::span<const Triangle> triangles, std::span<const Vec3> positions,
                std::span<const uint32_t> roots)
        : graph_(tables.graph), flipped_(tables.flipped), triangles_(triangles), positions_(positions),
          roots_(roots), former_vertices_(graph_.vertex_count()), former_triangles_(graph_.triangle_count()) {
    }

    bool run(SurfaceChange& change) {
        if (!may_follow()) {
            return false;
        }
        number_vertices();
        move_vertices();
        if (!number_triangles()) {
            return false;
        }
        std::vector<uint32_t> vertices = corners_of(changed_before_);
        tear();
        write_triangles();
        const std::vector<uint32_t> now = corners_of(changed_);
        vertices.insert(vertices.end(), now.begin(), now.end());
        for (auto v = static_cast<uint32_t>(former_vertices_); v < positions_.size(); ++v) {
            vertices.push_back(v);
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        link(vertices);
        std::sort(changed_.begin(), changed_.end());
        change.triangles = std::move(changed_);
        change.vertices = std::move(vertices);
        return true;
    }

    const std::vector<uint32_t>& torn() const { return torn_; }

  private:
    bool may_follow() const {
        return positions_.size() >= former_vertices_ && triangles_.size() >= former_triangles_ &&
               (roots_.empty() ? triangles_.size() == former_triangles_
                               : roots_.size() == triangles_.size()) &&
               std::all_of(roots_.begin(), roots_.end(),
                           [&](uint32_t root) { return root < former_triangles_; }) &&
               unit_of(positions_) == graph_.unit;
    }

    void number_vertices() {
        const Numbering added = number_by_place({}, positions_.subspan(former_vertices_));
        const auto first = static_cast<uint32_t>(former_vertices_);
        for (size_t i = 0; i < added.mesh_vertex.size(); ++i) {
            graph_.numbering.mesh_vertex.push_back(first + added.mesh_vertex[i]);
            graph_.numbering.new_vertex.push_back(first + added.new_vertex[i]);
        }
    }

    uint32_t root_slot(size_t t) const {
        return graph_.numbering.new_triangle[roots_.empty() ? t : roots_[t]];
    }

    /// Moves the vertices to their places; which were elsewhere?
    void move_vertices() {
        const double inverse = 1 / graph_.unit;
        graph_.places.resize(positions_.size());
        moved_.resize(positions_.size(), 1);
        parallel_for(positions_.size(), 1 << 13, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                const Vec3 place = positions_[graph_.numbering.mesh_vertex[v]] * inverse;
                moved_[v] = v >= former_vertices_ || place != graph_.places[v] ? 1 : 0;
                graph_.places[v] = place;
            }
        });
    }

    bool is_as_before(size_t t, uint32_t slot) const {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = graph_.numbering.new_vertex[triangles_[t][k]];
            if (vertex != graph_.corner_vertex[3 * size_t{slot} + k] || moved_[vertex] != 0) {
                return false;
            }
        }
        return true;
    }

    /// Triangles that stay keep their slots, others take those of their roots and then new ones.
    bool number_triangles() {
        std::vector<uint8_t> same(triangles_.size());
        parallel_for(triangles_.size(), 1 << 13, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t) {
                same[t] = is_as_before(t, root_slot(t)) ? 1 : 0;
            }
        });
        std::vector<uint32_t> numbers(triangles_.size(), no_index);
        std::vector<uint8_t> taken(former_triangles_);
        std::vector<NewTriangle> left;
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            const uint32_t slot = root_slot(t);
            if (same[t] != 0 && taken[slot] == 0) {
                numbers[t] = slot;
                taken[slot] = 1;
            } else {
                left.push_back({slot, t});
            }
        }
        std::sort(left.begin(), left.end(), [](const NewTriangle& a, const NewTriangle& b) {
            return a.root_slot != b.root_slot ? a.root_slot < b.root_slot : a.mesh_triangle < b.mesh_triangle;
        });
        auto next = static_cast<uint32_t>(former_triangles_);
        for (const NewTriangle& made : left) {
            const bool first = taken[made.root_slot] == 0;
            numbers[made.mesh_triangle] = first ? made.root_slot : next++;
            if (first) {
                taken[made.root_slot] = 1;
                changed_before_.push_back(made.root_slot);
            }
            changed_.push_back(numbers[made.mesh_triangle]);
            mesh_triangle_.push_back(made.mesh_triangle);
        }
        graph_.numbering.new_triangle = std::move(numbers);
        return std::find(taken.begin(), taken.end(), 0) == taken.end();
    }

    std::vector<uint32_t> corners_of(const std::vector<uint32_t>& slots) const {
        std::vector<uint32_t> corners;
        for (const uint32_t slot : slots) {
            corners.insert(corners.end(), graph_.corner_vertex.begin() + 3 * std::ptrdiff_t{slot},
                           graph_.corner_vertex.begin() + 3 * std::ptrdiff_t{slot} + 3);
        }
        return corners;
    }

    /// Collects what changed and all that flips had joined with it, before the links to it are gone.
    void tear() {
        std::vector<uint8_t> known(former_triangles_);
        torn_ = changed_before_;
        for (const uint32_t slot : torn_) {
            known[slot] = 1;
        }
        for (size_t i = 0; i < torn_.size(); ++i) {
            for (uint32_t k = 0; k < 3; ++k) {
                if ((flipped_[torn_[i]] >> k & 1) == 0) {
                    continue;
                }
                const uint32_t near = graph_.twin(3 * torn_[i] + k) / 3;
                if (known[near] == 0) {
                    known[near] = 1;
                    torn_.push_back(near);
                }
            }
        }
        flipped_.resize(triangles_.size());
        for (const uint32_t slot : torn_) {
            flipped_[slot] = 0;
        }
        for (auto slot = static_cast<uint32_t>(former_triangles_); slot < triangles_.size(); ++slot) {
            torn_.push_back(slot);
        }
    }

    void write_triangles() {
        graph_.corner_vertex.resize(3 * triangles_.size());
        graph_.across.resize(3 * triangles_.size(), no_index);
        for (size_t i = 0; i < changed_.size(); ++i) {
            const uint32_t first = 3 * changed_[i];
            for (uint32_t k = 0; k < 3; ++k) {
                graph_.corner_vertex[first + k] =
                    graph_.numbering.new_vertex[triangles_[mesh_triangle_[i]][k]];
                graph_.across[first + k] = no_index;
            }
            for (uint32_t k = 0; k < 3; ++k) {
                graph_.longest_side = std::max(graph_.longest_side, graph_.length(first + k));
            }
        }
    }

    /// The sides around the vertices, and the edges that meet there.
    void link(const std::vector<uint32_t>& vertices) {
        std::vector<EdgeSide> corners; // `other`: the vertex
        std::vector<uint8_t> is_changed(triangles_.size());
        for (const uint32_t slot : changed_) {
            is_changed[slot] = 1;
            for (uint32_t side = 3 * slot; side < 3 * slot + 3; ++side) {
                corners.push_back({graph_.from(side), side});
            }
        }
        for (const uint32_t v : vertices) {
            for (const uint32_t side :
                 v < former_vertices_ ? graph_.sides_leaving(v) : std::span<const uint32_t>()) {
                if (is_changed[side / 3] == 0) {
                    corners.push_back({v, side});
                }
            }
        }
        std::sort(corners.begin(), corners.end(), [](const EdgeSide& a, const EdgeSide& b) {
            return a.other != b.other ? a.other < b.other : a.side < b.side;
        });
        RowsAnew<uint32_t> rows{vertices, std::vector<uint32_t>(vertices.size()), {}};
        size_t next = 0;
        for (size_t i = 0; i < vertices.size(); ++i) {
            for (; next < corners.size() && corners[next].other == vertices[i]; ++next) {
                rows.items.push_back(corners[next].side);
                ++rows.counts[i];
            }
        }
        graph_.leaving_begin.resize(positions_.size() + 1);
        replace_rows(graph_.leaving, rows, former_vertices_, positions_.size(),
                     [&](size_t v) -> uint32_t& { return graph_.leaving_begin[v]; });
        std::vector<EdgeSide> scratch;
        for (const uint32_t v : vertices) {
            link_edges_of(graph_, v, scratch);
        }
    }

    TriangleGraph& graph_;
    std::vector<uint8_t>& flipped_;
    std::span<const Triangle> triangles_;
    std::span<const Vec3> positions_;
    std::span<const uint32_t> roots_;
    size_t former_vertices_, former_triangles_;
    std::vector<uint8_t> moved_;           ///< per vertex
    std::vector<uint32_t> changed_before_; ///< slots whose triangle is another now
    std::vector<uint32_t> changed_;        ///< these and the new ones
    std::vector<uint32_t> mesh_triangle_;  ///< of each that changed
    std::vector<uint32_t> torn_;
};

} // namespace

SurfaceTables make_surface_tables(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
    SurfaceTables tables;
    tables.graph = make_triangle_graph(triangles, positions, number_by_place(triangles, positions));
    IntrinsicGraph cut = by_lengths(tables.graph);
    IntrinsicDelaunay delaunay = flip_to_delaunay(cut);
    tables.fans = make_fan_table(cut, delaunay.origins);
    tables.flipped = std::move(delaunay.flipped);
    return tables;
}

bool update_surface_tables(SurfaceTables& tables, std::span<const Triangle> triangles,
                           std::span<const Vec3> positions, std::span<const uint32_t> roots,
                           SurfaceChange& change) {
    GraphUpdate update(tables, triangles, positions, roots);
    return update.run(change) && (change.vertices.empty() || update_fans(tables, update.torn(), change));
}

} // namespace anvil
