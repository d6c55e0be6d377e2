// Where along an edge linear interpolation misses a handle's weight most: eq. 18 with the distance along the
// edge in place of a distance that grows linearly.
#pragma once

#include "engine/refine/handle_field.h"

namespace anvil {

/// One edge by its ends.
struct EdgeSpan {
    uint32_t a = 0;
    uint32_t b = 0;
    double length = 0; ///< > 0
};

/// `error` is the largest difference to one side plus that to the other: where one side is missed, eq. 18.
/// `place` in (0, 1), from a to b, is where the larger one is, or 0 where `error` is only a bound.
/// Both sides count because of what comes later: an edge that is missed by 0.9 to both is within a tolerance
/// of 1, but one close beside it that begins at its first extremum is not, and splits that follow would pile
/// up against the edge for ever. With the sum every part of an edge within the tolerance is within it too.
struct EdgeError {
    double error = 0;
    double place = 0;
    uint32_t level = no_index; ///< index into the levels of the handle if the worst place is a kink
};

/// Measures one handle's error on edges; one thread at a time. The field must outlive it, and may grow.
class EdgeMeasure {
  public:
    explicit EdgeMeasure(const HandleField& handle);

    /// Largest phi(g(s) / R) - linear interpolation of its end values, exact to a few per cent of `enough` or
    /// better; where a bound shows that it is at most `enough`, that bound. Candidates: levels of
    /// the shape, crossings of two anchors' distances, turning points, and extrema between these.
    EdgeError worst(const EdgeSpan& edge, double enough);

    /// Inner places in (0, 1) where gamma is exactly that of the level, ascending.
    const std::vector<double>& crossings(const EdgeSpan& edge, size_t level);

    /// Whether any place of the edge is within the radius.
    bool reaches(const EdgeSpan& edge) { return load(edge); }

    /// gamma at a place in [0, 1].
    double distance(const EdgeSpan& edge, double place);

    const std::vector<ShapeLevel>& levels() const { return levels_; }

  private:
    struct Break {
        double s;
        uint32_t level;
    };
    struct Extreme {
        double size = 0;
        double s = 0;
        uint32_t level = no_index;
    };
    struct Bounds {
        double slope, curvature;
    };

    bool load(const EdgeSpan& edge);
    void drop_hidden_parts();
    double gamma(double s);
    double error(double s);
    double smooth_bound() const;
    Bounds bounds_between(double low, double high) const;
    void find_breaks();
    void find_level(uint32_t level);
    void find_blended_level(uint32_t level);
    void find_crossings();
    void search_piece(double from, double to, double enough);
    void sample_piece(double from, double to);
    void try_place(double s, uint32_t level);
    double climb(double from, double to, double sign);

    const HandleField& handle_;
    std::vector<ShapeLevel> levels_;
    std::vector<Bounds> bounds_; ///< per segment of the shape
    double spread_ = 0;          ///< the blend is at most so much below the least distance

    EdgeSpan edge_;
    double start_value_ = 0, end_value_ = 0;
    std::vector<EdgeDistance> parts_; ///< of the anchors that show on this edge
    std::vector<double> each_;
    std::vector<Break> breaks_;
    Extreme above_, below_; ///< the largest errors to either side so far
    std::vector<double> samples_;
    std::vector<double> places_;
};

} // namespace anvil
