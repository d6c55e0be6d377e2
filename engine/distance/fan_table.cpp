#include "engine/distance/fan_table.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel_for.h"
#include "engine/distance/angle_functions.h"
#include "engine/distance/unfold.h"

namespace anvil {
namespace {

struct Corner {
    double angle = 0;
    float cosine = 1, sine = 0;
};

/// Of a triangle, the corner k between sides k and k - 1.
std::array<Corner, 3> corners_between(const std::array<double, 3>& length) {
    const double four_areas = std::sqrt(sixteen_area_squared(length[0], length[1], length[2]));
    std::array<Corner, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
        const double base = length[k], opposite = length[(k + 1) % 3], left = length[(k + 2) % 3];
        // All three times twice the product of the sides.
        const double along = base * base + (left - opposite) * (left + opposite);
        const double size = 2 * base * left;
        if (size > 0) {
            // Lengths that no triangle has make a flat one.
            corners[k] = {half_turn_angle(along, four_areas),
                          static_cast<float>(std::clamp(along / size, -1.0, 1.0)),
                          static_cast<float>(std::min(four_areas / size, 1.0))};
        }
    }
    return corners;
}

class Builder {
  public:
    Builder(const IntrinsicGraph& graph, std::span<const DirectionOrigin> origins)
        : graph_(graph), origins_(origins), shapes_(graph.vertex_count()) {
        fill_large(corners_, graph.corner_vertex.size());
        fill_large(directions_, graph.corner_vertex.size());
    }

    FanTable build() {
        const size_t count = graph_.vertex_count();
        table_.fans.reserve(with_room(count + 1));
        table_.fans.resize(count + 1);
        parallel_for(graph_.triangle_count(), 1 << 13, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t) {
                const double* length = &graph_.side_length[3 * t];
                const std::array<Corner, 3> corners = corners_between({length[0], length[1], length[2]});
                std::copy(corners.begin(), corners.end(), corners_.begin() + 3 * static_cast<ptrdiff_t>(t));
            }
        });
        parallel_for(count, 1 << 12, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                measure(static_cast<uint32_t>(v));
            }
        });
        uint32_t place = 0;
        for (size_t v = 0; v < count; ++v) {
            table_.fans[v].first_spoke = place;
            place += spoke_count(static_cast<uint32_t>(v));
        }
        table_.fans[count].first_spoke = place;
        fill_large(table_.spokes, place, with_room(place));
        parallel_for(count, 1 << 12, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                fill(static_cast<uint32_t>(v));
            }
        });
        sum_lengths(table_);
        return std::move(table_);
    }

  private:
    uint32_t spoke_count(uint32_t vertex) const {
        const auto corners = static_cast<uint32_t>(graph_.sides_leaving(vertex).size());
        switch (shapes_[vertex].kind) {
        case FanShape::Kind::closed:
            return corners;
        case FanShape::Kind::open:
            return corners + 1;
        default:
            return 2 * corners;
        }
    }

    double angle(uint32_t side) const { return corners_[side].angle; }

    void measure(uint32_t vertex) {
        FanShape& shape = shapes_[vertex];
        Fan& fan = table_.fans[vertex];
        const DirectionOrigin& origin = origins_[vertex];
        if (origin.side == no_index) {
            return;
        }
        // Nearly every fan closes: one walk finds that out and measures.
        Walk walk = walk_from(origin.side, origin.direction);
        if (walk.corners == graph_.sides_leaving(vertex).size() && walk.closes) {
            shape = {FanShape::Kind::closed, origin.side};
            fan.total = static_cast<float>(walk.total);
            wrap(origin.side, fan.total);
            return;
        }
        shape = fan_shape(graph_, vertex, origin.side);
        if (shape.kind == FanShape::Kind::open) {
            walk_from(shape.first, 0);
            fan.total = Fan::open;
        }
    }

    struct Walk {
        size_t corners = 0;
        double total = 0;
        bool closes = false;
    };
    /// Sets the directions of the sides counterclockwise of `first` until they close or end.
    Walk walk_from(uint32_t first, double direction) {
        Walk walk;
        uint32_t side = first;
        do {
            directions_[side] = static_cast<float>(direction + walk.total);
            walk.total += angle(side);
            ++walk.corners;
            side = graph_.twin(TriangleGraph::previous(side));
        } while (side < TriangleGraph::tangled && side != first);
        walk.closes = side == first;
        return walk;
    }

    /// Brings the directions of a closed fan into [0, total).
    void wrap(uint32_t first, float total) {
        uint32_t side = first;
        do {
            float& direction = directions_[side];
            direction -= total * std::floor(direction / total);
            direction = direction < total ? direction : 0;
            side = graph_.twin(TriangleGraph::previous(side));
        } while (side != first);
    }

    /// Direction, at the vertex that `side` arrives at, of the way back along it.
    float back_direction(uint32_t side) const {
        const uint32_t twin = graph_.twin(side);
        if (twin < TriangleGraph::tangled) {
            return directions_[twin];
        }
        const uint32_t next = TriangleGraph::next(side);
        return static_cast<float>(directions_[next] + angle(next));
    }

    Spoke leaving_spoke(uint32_t side) const {
        return {graph_.to(side),       static_cast<float>(graph_.side_length[side]),
                directions_[side],     back_direction(side),
                corners_[side].cosine, corners_[side].sine};
    }

    /// The spoke at the counterclockwise end of the corner that `side` leaves.
    Spoke end_spoke(uint32_t side) const {
        const uint32_t arriving = TriangleGraph::previous(side);
        return {graph_.from(arriving),
                static_cast<float>(graph_.side_length[arriving]),
                static_cast<float>(directions_[side] + angle(side)),
                directions_[arriving],
                1,
                Spoke::no_corner};
    }

    void fill(uint32_t vertex) {
        Spoke* spoke = table_.spokes.data() + table_.fans[vertex].first_spoke;
        const FanShape& shape = shapes_[vertex];
        if (shape.kind == FanShape::Kind::tangled) {
            for (const uint32_t side : graph_.sides_leaving(vertex)) {
                *spoke++ = leaving_spoke(side);
                *spoke++ = end_spoke(side);
            }
            return;
        }
        uint32_t side = shape.first;
        while (true) {
            *spoke++ = leaving_spoke(side);
            const uint32_t next = graph_.twin(TriangleGraph::previous(side));
            if (next == TriangleGraph::boundary) {
                *spoke = end_spoke(side);
                return;
            }
            if (next == shape.first) {
                return;
            }
            side = next;
        }
    }

    const IntrinsicGraph& graph_;
    std::span<const DirectionOrigin> origins_;
    std::vector<FanShape> shapes_;
    std::vector<Corner> corners_;
    std::vector<float> directions_;
    FanTable table_;
};

} // namespace

FanTable make_fan_table(const IntrinsicGraph& graph, std::span<const DirectionOrigin> origins) {
    return Builder(graph, origins).build();
}

void sum_lengths(FanTable& table) {
    double sum = 0;
    table.longest = 0;
    for (const Spoke& spoke : table.spokes) {
        sum += static_cast<double>(spoke.length);
        table.longest = std::max(table.longest, static_cast<double>(spoke.length));
    }
    table.mean_length = table.spokes.empty() ? 0 : sum / static_cast<double>(table.spokes.size());
}

double corner_angle(const TriangleGraph& graph, uint32_t side) {
    const uint32_t first = side - side % 3;
    return corners_between({graph.length(first), graph.length(first + 1), graph.length(first + 2)})[side % 3]
        .angle;
}

FanShape fan_shape(const TriangleLinks& graph, uint32_t vertex, uint32_t wished_first) {
    const size_t count = graph.sides_leaving(vertex).size();
    if (wished_first == no_index) {
        return {};
    }
    uint32_t first = wished_first;
    size_t turns = 0;
    bool open = false;
    // Clockwise, to the start of an open fan or once around.
    for (; turns <= count; ++turns) {
        const uint32_t twin = graph.twin(first);
        if (twin == TriangleGraph::tangled) {
            return {};
        }
        if (twin == TriangleGraph::boundary) {
            open = true;
            break;
        }
        first = TriangleGraph::next(twin);
        if (first == wished_first) {
            ++turns;
            break;
        }
    }
    if (!open) {
        return turns == count ? FanShape{FanShape::Kind::closed, wished_first} : FanShape{};
    }
    size_t corners = 1;
    for (uint32_t side = first; corners <= count; ++corners) {
        side = graph.twin(TriangleGraph::previous(side));
        if (side == TriangleGraph::boundary) {
            return corners == count ? FanShape{FanShape::Kind::open, first} : FanShape{};
        }
        if (side == TriangleGraph::tangled) {
            return {};
        }
    }
    return {};
}

} // namespace anvil
