// Sources of any kind turned into start values at vertices.
#pragma once

#include "engine/distance/triangle_graph.h"
#include "engine/distance/unfold.h"
#include "engine/mesh/surface_point.h"

#include <optional>

namespace anvil {

/// A vertex (of the graph) that sees source number `label` in a straight line, at `distance` (units of the
/// graph).
struct Seed {
    uint32_t vertex = 0;
    uint32_t label = 0;
    double distance = 0;
    uint32_t side =
        no_index;         ///< leaves the vertex, in a triangle that holds the source; none: it is the vertex
    double angle = 0;     ///< from the side to the source, within that triangle
    bool of_line = false; ///< the source is a line there, met at a right angle
};

/// A point of the surface by the graph's numbers: the side of its triangle that it is laid out over, and its
/// place.
struct PlacedPoint {
    uint32_t vertex = no_index; ///< set if the point is a vertex; the rest is then unset
    uint32_t base = no_index;
    double weight_end = 0,
           weight_apex = 0; ///< of the base's end and of the apex; the base's start has the rest
    bool on_base = false;   ///< lies on the base: other triangles there hold it too
};

/// Weights within 1e-12 of 0 count as 0. `index` and `kind` name the source in errors.
/// @throws InputError if the point is none of this surface.
PlacedPoint placed(const TriangleGraph& graph, const SurfacePoint& point, const char* kind, size_t index);

/// Start, end and apex of the triangle over `base`, in its frame.
std::array<PlanePoint, 3> laid_out(const TriangleGraph& graph, uint32_t base);

/// The place of a point in the triangle over `base`, in its frame, if that triangle holds it.
std::optional<PlanePoint> place_in(const TriangleGraph& graph, const PlacedPoint& point, uint32_t base);

/// One side of every triangle that holds the point.
std::vector<uint32_t> triangles_with(const TriangleGraph& graph, const PlacedPoint& point);

/// Seeds at the corners of the triangle over `base` for a source that lies at feet[k] as seen from corner k.
void seed_corners(const TriangleGraph& graph, uint32_t base, const std::array<PlanePoint, 3>& feet, Seed like,
                  std::vector<Seed>& seeds);

/// Seeds of one point: the vertex itself, or the corners of all triangles that hold it.
void seed_point(const TriangleGraph& graph, const PlacedPoint& point, uint32_t label,
                std::vector<Seed>& seeds);

/// The sides of the edge of `side`, it among them, each with whether it runs the same way.
struct LikeSide {
    uint32_t side;
    bool same_way;
};
std::vector<LikeSide> sides_of_edge(const TriangleGraph& graph, uint32_t side);

} // namespace anvil
