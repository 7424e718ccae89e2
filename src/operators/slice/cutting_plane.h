// A plane in scaled space: which side of it a point lies on, exactly, and where an edge crosses it.
#pragma once

#include <optional>

#include "grid/scaled_space.h"
#include "mandoline/slice.h"
#include "operators/triangulate/plane_point.h"

namespace mandoline::operators {

class CuttingPlane {
 public:
  /// Nothing for a plane that misses the grid. The plane's numbers must be finite, and its normal not zero.
  static std::optional<CuttingPlane> make(const Plane& plane, const Grid& grid, const ScaledSpace& space);

  /// All points on the plane count as above it, or as below if nothing else is below.
  bool isAbove(const ScaledPoint& p) const {
    const int sign = signAt(p);
    return sign > 0 || (sign == 0 && onIsAbove_);
  }
  /// In units of the normal's length; 0 where rounding a coordinate could bring the point onto the plane.
  double distanceAt(const ScaledPoint& p) const;

  /// An end of an edge, and its distance.
  struct End {
    const ScaledPoint& at;
    double distance;
  };
  /// Where the edge of two points on different sides crosses the plane. `end` is 0 or 1 if that is the edge's end a or b, else -1: an end
  /// that rounding can't tell from the plane is the place, so that all edges that meet there cross at one place.
  struct Crossing {
    ScaledPoint at;
    int end;
  };
  static Crossing crossing(const End& a, const End& b);
  Crossing crossing(const ScaledPoint& a, const ScaledPoint& b) const { return crossing({a, distanceAt(a)}, {b, distanceAt(b)}); }

  /// Seen so that the normal points up: along the axis that it is steepest to.
  PlanePoint seen(const ScaledPoint& p) const { return {p[right_], p[up_]}; }
  const ScaledPoint& normal() const { return normal_; }
  double offset() const { return offset_; }

 private:
  int signAt(const ScaledPoint& p) const;
  double sizeAt(const ScaledPoint& p) const;

  ScaledPoint normal_{};
  double offset_ = 0;
  bool onIsAbove_ = true;
  int right_ = 0, up_ = 1;
};

}  // namespace mandoline::operators
