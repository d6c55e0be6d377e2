#include "engine/distance/row_table.h"
#include "engine/distance/surface_tables.h"

namespace anvil {
namespace {

// The rim of the change moves out where flips cross it; more often than this they go everywhere.
constexpr int most_rounds = 16;

/// Numbers taken up once each.
class NumberSet {
  public:
    explicit NumberSet(size_t count) : known_(count) {}

    void add(uint32_t number) {
        if (known_[number] == 0) {
            known_[number] = 1;
            numbers_.push_back(number);
        }
    }
    bool has(uint32_t number) const { return known_[number] != 0; }
    /// In order of arrival until sort().
    const std::vector<uint32_t>& numbers() const { return numbers_; }
    void sort() { std::sort(numbers_.begin(), numbers_.end()); }

  private:
    std::vector<uint8_t> known_;
    std::vector<uint32_t> numbers_;
};

class FanUpdate {
  public:
    FanUpdate(SurfaceTables& tables, std::span<const uint32_t> torn, const SurfaceChange& change)
        : tables_(tables), graph_(tables.graph), changed_vertices_(change.vertices),
          torn_(graph_.triangle_count()) {
        for (const uint32_t triangle : torn) {
            torn_.add(triangle);
        }
    }

    bool run(SurfaceChange& change) {
        for (int round = 0; round < most_rounds; ++round) {
            if (!choose_part()) {
                return false;
            }
            cut_out();
            IntrinsicDelaunay delaunay = flip_to_delaunay(part_);
            const size_t before = torn_.numbers().size();
            tear_across(delaunay.flipped);
            if (torn_.numbers().size() == before) {
                change.flipped = triangles_.size();
                return take_over(delaunay, change);
            }
        }
        return false;
    }

  private:
    /// All triangles joined by flips, or by an edge of a kind that is never flipped, with one of the set.
    void complete(NumberSet& triangles) const {
        for (size_t i = 0; i < triangles.numbers().size(); ++i) {
            const uint32_t triangle = triangles.numbers()[i];
            for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                const uint32_t twin = graph_.twin(side);
                if (twin == TriangleGraph::tangled) {
                    triangles.add((graph_.across[side] >> 1) / 3);
                } else if ((tables_.flipped[triangle] >> side % 3 & 1) != 0) {
                    triangles.add(twin / 3);
                }
            }
        }
    }

    void add_around(const NumberSet& vertices, NumberSet& triangles) const {
        for (const uint32_t v : vertices.numbers()) {
            for (const uint32_t side : graph_.sides_leaving(v)) {
                triangles.add(side / 3);
            }
        }
        complete(triangles);
    }

    void add_corners(const std::vector<uint32_t>& triangles, NumberSet& vertices) const {
        for (const uint32_t triangle : triangles) {
            for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                vertices.add(graph_.from(side));
            }
        }
    }

    /// The part of the surface that is looked at: whole around every vertex whose spokes change, and around
    /// the vertices next to these.
    bool choose_part() {
        centre_ = NumberSet(graph_.vertex_count());
        for (const uint32_t v : changed_vertices_) {
            centre_.add(v);
        }
        add_corners(torn_.numbers(), centre_);
        NumberSet triangles(graph_.triangle_count()), vertices(graph_.vertex_count());
        for (const uint32_t triangle : torn_.numbers()) {
            triangles.add(triangle);
        }
        add_around(centre_, triangles);
        add_corners(triangles.numbers(), vertices);
        add_around(vertices, triangles);
        // Beyond this making all anew costs no more.
        if (2 * triangles.numbers().size() > graph_.triangle_count()) {
            return false;
        }
        add_corners(triangles.numbers(), vertices);
        triangles.sort();
        triangles_ = triangles.numbers();
        for (const uint32_t v : centre_.numbers()) {
            vertices.add(v);
        }
        vertices.sort();
        vertices_ = vertices.numbers();
        return true;
    }

    /// A surface of its own; numbers keep their order, which decides among equally good flips.
    void cut_out() {
        std::vector<uint32_t> local_triangle(graph_.triangle_count(), no_index);
        for (uint32_t i = 0; i < triangles_.size(); ++i) {
            local_triangle[triangles_[i]] = i;
        }
        part_ = IntrinsicGraph();
        for (const uint32_t triangle : triangles_) {
            for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                const uint32_t link = graph_.across[side];
                const uint32_t other = link == no_index ? no_index : link >> 1;
                const uint32_t there = link == no_index ? no_index : local_triangle[other / 3];
                part_.corner_vertex.push_back(local_vertex(graph_.from(side)));
                part_.side_length.push_back(graph_.length(side));
                part_.across.push_back(there == no_index ? no_index
                                                         : 2 * (3 * there + other % 3) + (link & 1));
            }
        }
        link_vertices(part_, vertices_.size());
    }

    uint32_t local_vertex(uint32_t vertex) const {
        return static_cast<uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) -
                                     vertices_.begin());
    }

    /// What flips have joined with the change is torn as well.
    void tear_across(const std::vector<uint8_t>& flipped) {
        std::vector<uint32_t> local_triangle(graph_.triangle_count(), no_index);
        for (uint32_t i = 0; i < triangles_.size(); ++i) {
            local_triangle[triangles_[i]] = i;
        }
        for (size_t i = 0; i < torn_.numbers().size(); ++i) {
            const uint32_t triangle = torn_.numbers()[i], local = local_triangle[triangle];
            for (uint32_t k = 0; k < 3; ++k) {
                if (local != no_index && (flipped[local] >> k & 1) != 0) {
                    torn_.add(graph_.twin(3 * triangle + k) / 3);
                }
                if ((tables_.flipped[triangle] >> k & 1) != 0) {
                    torn_.add(graph_.twin(3 * triangle + k) / 3);
                }
            }
        }
    }

    bool take_over(const IntrinsicDelaunay& delaunay, SurfaceChange& change) {
        for (size_t i = 0; i < triangles_.size(); ++i) {
            uint8_t& flipped = tables_.flipped[triangles_[i]];
            if (torn_.has(triangles_[i])) {
                flipped = delaunay.flipped[i];
            } else if (flipped != delaunay.flipped[i]) {
                return false;
            }
        }
        const FanTable made = make_fan_table(part_, delaunay.origins);
        const size_t former_count = tables_.fans.fans.size() - 1;
        centre_.sort();
        RowsAnew<Spoke> rows{centre_.numbers(), {}, {}};
        tables_.fans.fans.resize(graph_.vertex_count() + 1);
        NumberSet rim(vertices_.size());
        for (const uint32_t v : centre_.numbers()) {
            copy_row(made, local_vertex(v), rows, rim);
        }
        if (!turn_back_directions(made, rim)) {
            return false;
        }
        replace_rows(tables_.fans.spokes, rows, former_count, graph_.vertex_count(),
                     [&](size_t v) -> uint32_t& { return tables_.fans.fans[v].first_spoke; });
        sum_lengths(tables_.fans);
        change.fans = centre_.numbers().size();
        return true;
    }

    void copy_row(const FanTable& made, uint32_t local, RowsAnew<Spoke>& rows, NumberSet& rim) {
        const uint32_t first = made.fans[local].first_spoke, end = made.fans[local + 1].first_spoke;
        Fan& fan = tables_.fans.fans[vertices_[local]];
        fan.total = made.fans[local].total;
        for (uint32_t i = first; i < end; ++i) {
            rows.items.push_back(made.spokes[i]);
            if (!centre_.has(vertices_[made.spokes[i].vertex])) {
                rim.add(made.spokes[i].vertex);
            }
            rows.items.back().vertex = vertices_[made.spokes[i].vertex];
        }
        rows.counts.push_back(end - first);
    }

    /// Vertices next to those whose fans are new keep their spokes, but for the directions at these.
    bool turn_back_directions(const FanTable& made, const NumberSet& rim) {
        for (const uint32_t local : rim.numbers()) {
            const uint32_t first = made.fans[local].first_spoke, end = made.fans[local + 1].first_spoke;
            const uint32_t v = vertices_[local], former = tables_.fans.fans[v].first_spoke;
            if (tables_.fans.fans[v + 1].first_spoke - former != end - first) {
                return false;
            }
            for (uint32_t i = first; i < end; ++i) {
                Spoke& spoke = tables_.fans.spokes[former + i - first];
                if (spoke.vertex != vertices_[made.spokes[i].vertex] ||
                    spoke.length != made.spokes[i].length) {
                    return false;
                }
                spoke.back = centre_.has(spoke.vertex) ? made.spokes[i].back : spoke.back;
            }
        }
        return true;
    }

    SurfaceTables& tables_;
    const TriangleGraph& graph_;
    const std::vector<uint32_t>& changed_vertices_;
    NumberSet torn_;
    NumberSet centre_{0};                        ///< vertices whose spokes are made anew
    std::vector<uint32_t> triangles_, vertices_; ///< of the part, ascending
    IntrinsicGraph part_;
};

} // namespace

bool update_fans(SurfaceTables& tables, std::span<const uint32_t> torn, SurfaceChange& change) {
    return FanUpdate(tables, torn, change).run(change);
}

} // namespace anvil
