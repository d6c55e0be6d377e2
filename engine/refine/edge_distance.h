// How the distance from a source runs along a straight edge, known from its values at both ends.
#pragma once

#include "engine/core/types.h"

#include <array>

namespace anvil {

/// What a distance was measured from, as far as one edge can tell: a point, or a line or face, whose fronts
/// are flat where they were not bent.
enum class SourceKind { point, line };

/// Distance g(s) at s in [0, length] along an edge whose ends are at distances d0 and d1: section 3's virtual
/// source, g(s)^2 = (s - x)^2 + y^2, in Stewart's form (1 - s/L) d0^2 + (s/L) d1^2 - s (L - s), which has no
/// differences of large numbers. Where no point of the plane has these distances, both ends keep theirs:
/// linear if they differ by more than the edge is long (a field that is not a distance), two fronts that
/// meet if they sum to less (a way around that is shorter than the edge). Lines: linear.
class EdgeDistance {
  public:
    /// Distances >= 0, at most one of them infinite; length > 0.
    EdgeDistance(double d0, double d1, double length, SourceKind kind = SourceKind::point);

    double at(double s) const;
    /// Where g has its inner extremum: the foot of the source, or the place where two fronts meet; NaN if
    /// there is none inside the edge.
    double turning_point() const { return turning_; }
    double least() const { return least_; }
    double greatest() const { return greatest_; }
    /// True where g is a straight line between the ends.
    bool is_linear() const { return form_ == Form::linear; }

    /// The inner places, ascending, with g(s) = distance; NaN fills up.
    std::array<double, 2> places_at(double distance) const;

  private:
    enum class Form { source, linear, meeting, one_end };
    void find_extremes();

    double d0_, d1_, length_;
    Form form_;
    double turning_, least_, greatest_;
};

/// The distance at a place in [0, 1] of an edge: what a new vertex there gets. Infinite where both ends are.
double distance_between(double d0, double d1, double length, double place, SourceKind kind);

} // namespace anvil
