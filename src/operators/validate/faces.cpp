// Cut-faces (paper, 3.4) and their two sides: planes, loops, and who owns which half-face; grid cell isolation (5.6).
#include <algorithm>

#include "operators/validate/context.h"

namespace mandoline::validation {
namespace {

class FaceCheck {
 public:
  explicit FaceCheck(const Context& context) : x_(context) {}

  void run(std::vector<Check>& checks) {
    for (size_t f = 0; f < x_.cut.faceCount(); ++f) {
      checkPlane(f);
      checkLoops(f);
      if (x_.cut.faceAxis[f] < 0) {
        checkInnerSides(f);
      } else {
        checkAxialSides(f);
      }
    }
    checkListings();
    checkIsolation();
    for (Tally* tally : {&faces_, &planarity_, &orientation_, &halfFaces_, &isolation_}) checks.push_back(tally->finish());
  }

 private:
  void checkPlane(size_t f) {
    const int axis = x_.cut.faceAxis[f];
    const int32_t t = x_.cut.faceTriangle[f], plane = x_.cut.facePlane[f];
    if (t >= 0 && x_.dropped[t]) faces_.violate("face", int64_t(f), "names a dropped triangle");
    for (int d = 0; d < 3; ++d) {
      if (x_.faceGridCell[3 * f + d] < 0)
        return isolation_.violate("face", int64_t(f), "lies in several grid cells, or in an axial plane that it does not name");
    }
    bool inPlane = true;
    if (axis >= 0) {
      x_.forLoops(f, [&](std::span<const uint32_t> loop) {
        for (const uint32_t v : loop) inPlane &= x_.onPlane(v, axis) && x_.cellAt(v)[axis] == plane;
      });
      for (int i = 0; t >= 0 && i < 3; ++i) inPlane &= x_.corner(t, i)[axis] == x_.planes[axis][plane];
    }
    if (!inPlane) faces_.violate("face", int64_t(f), "is not in the axial plane that it names");
  }

  void checkLoops(size_t f) {
    const int32_t t = x_.cut.faceTriangle[f];
    const Vec3 origin = x_.vertex(x_.cut.loop(x_.cut.faceLoopOffsets[f])[0]);
    Vec3 a, b, c;
    int axis = x_.cut.faceAxis[f], sign = 1;
    if (t >= 0) {
      a = x_.inRoundings(x_.corner(t, 0), origin), b = x_.inRoundings(x_.corner(t, 1), origin), c = x_.inRoundings(x_.corner(t, 2), origin);
      if (axis < 0) axis = dominantAxis(cross(b - a, c - a));
      sign = turn(x_.corner(t, 0), x_.corner(t, 1), x_.corner(t, 2), axis);
    }
    bool outer = true;
    x_.forLoops(f, [&](std::span<const uint32_t> loop) {
      double area = 0, boundary = 1;  // projected along the axis
      Vec3 from = x_.inRoundings(x_.vertex(loop.back()), origin);
      const Vec3 first = from;
      for (const uint32_t v : loop) {
        const Vec3 to = x_.inRoundings(x_.vertex(v), origin);
        area += cross(from - first, to - first)[axis] / 2;
        boundary += std::fabs(to[(axis + 1) % 3] - from[(axis + 1) % 3]) + std::fabs(to[(axis + 2) % 3] - from[(axis + 2) % 3]);
        if (t >= 0) planarity_.measure(distanceToTriangle(to, a, b, c), "face", int64_t(f), "has a vertex off its triangle");
        from = to;
      }
      const double wrong = outer ? -sign * area : sign * area;
      if (wrong > 0)
        orientation_.measure(wrong / boundary, "face", int64_t(f),
                             outer ? "has a clockwise outer loop" : "has a hole that is not clockwise");
      outer = false;
    });
  }

  /// A tri-face inside of a grid cell: both sides belong to cut-cells.
  void checkInnerSides(size_t f) {
    if (x_.owner[2 * f] < 0 || x_.owner[2 * f + 1] < 0)
      halfFaces_.violate("face", int64_t(f), "lies inside of a grid cell, but a side of it belongs to no cut-cell");
  }

  void checkAxialSides(size_t f) {
    const int axis = x_.cut.faceAxis[f], up = x_.axialSide(f);
    std::array<int64_t, 3> beyond{x_.faceGridCell[3 * f], x_.faceGridCell[3 * f + 1], x_.faceGridCell[3 * f + 2]};
    if (*std::min_element(beyond.begin(), beyond.end()) < 0) return;
    if (x_.owner[2 * f] < 0 && x_.owner[2 * f + 1] < 0) return halfFaces_.violate("face", int64_t(f), "belongs to no cut-cell");
    for (int side = 0; side < 2; ++side) {
      beyond[axis] = x_.cut.facePlane[f] - ((side == 0) == (up > 0) ? 1 : 0);
      const int32_t c = x_.owner[2 * f + side];
      if (c >= 0) {
        if (x_.gridCellOf(c)[axis] != beyond[axis])
          halfFaces_.violate("face", int64_t(f), "has a side that belongs to a cut-cell on the other side of its plane");
      } else if (beyond[axis] >= 0 && beyond[axis] < x_.cut.grid.cells(axis)) {
        if (x_.runAt(beyond[0], beyond[1], beyond[2]) < 0) {
          halfFaces_.violate("face", int64_t(f), "has a side that belongs to no cut-cell and faces no untouched grid cell");
        } else if (x_.cut.faceTriangle[f] >= 0) {
          halfFaces_.violate("face", int64_t(f), "is part of a triangle and faces an untouched grid cell");
        } else if (!isWholeGridFace(f)) {
          halfFaces_.violate("face", int64_t(f), "faces an untouched grid cell, but is no whole grid-face");
        }
      }
    }
  }

  /// One loop along the sides of the square, through its corners.
  bool isWholeGridFace(size_t f) const {
    if (x_.cut.faceLoopOffsets[f + 1] - x_.cut.faceLoopOffsets[f] != 1) return false;
    const std::span<const uint32_t> loop = x_.cut.loop(x_.cut.faceLoopOffsets[f]);
    const int e = (x_.cut.faceAxis[f] + 1) % 3, g = (x_.cut.faceAxis[f] + 2) % 3;
    const int32_t ce = x_.faceGridCell[3 * f + e], cg = x_.faceGridCell[3 * f + g];
    // Sides in the order of the loop; a vertex lies on those whose line its mask names.
    const auto onSide = [&](uint32_t v, int side) {
      const int axis = side % 2 == 0 ? g : e;
      const int32_t plane = side == 0 ? cg : side == 1 ? ce + 1 : side == 2 ? cg + 1 : ce;
      return x_.onPlane(v, axis) && x_.cellAt(v)[axis] == plane;
    };
    const auto isCorner = [&](uint32_t v, int side) { return onSide(v, side) && onSide(v, (side + 3) % 4); };  // where a side begins
    const auto start = std::find_if(loop.begin(), loop.end(), [&](uint32_t v) { return isCorner(v, 0); });
    if (start == loop.end()) return false;
    int side = 0;
    for (size_t i = 1; i <= loop.size(); ++i) {
      const uint32_t u = loop[size_t(start - loop.begin() + int64_t(i) - 1) % loop.size()],
                     v = loop[size_t(start - loop.begin() + int64_t(i)) % loop.size()];
      if (!onSide(v, side)) return false;
      const int axis = side % 2 == 0 ? e : g, sign = side < 2 ? 1 : -1;
      if ((x_.vertex(v)[axis] - x_.vertex(u)[axis]) * sign < -kTolerance * x_.rounding[axis]) return false;
      if (side < 4 && isCorner(v, (side + 1) % 4)) ++side;
      if (side == 4 && i < loop.size()) return false;
    }
    return side == 4;
  }

  void checkListings() {
    std::vector<uint8_t> listed(2 * x_.cut.faceCount(), 0);
    for (const uint32_t h : x_.cut.cellHalfFaces) {
      if (listed[h] == 1) halfFaces_.violate("face", h / 2, "has a side that is listed more than once");
      if (listed[h] < 2) ++listed[h];
    }
  }

  void checkIsolation() {
    for (size_t c = 0; c < x_.cut.cellCount(); ++c) {
      if (!liesInGridCell(c)) isolation_.violate("cell", int64_t(c), "has a vertex outside of its grid cell");
    }
  }
  bool liesInGridCell(size_t c) const {
    const int32_t* gridCell = x_.gridCellOf(c);
    bool inside = true;
    for (const uint32_t h : x_.cut.halfFaces(c)) {
      x_.forLoops(h / 2, [&](std::span<const uint32_t> loop) {
        for (const uint32_t v : loop) {
          for (int d = 0; d < 3; ++d) inside &= x_.inSlab(v, d, gridCell[d]);
        }
      });
    }
    return inside;
  }

  const Context& x_;
  Tally faces_{"faces"}, planarity_{"planarity", kTolerance}, orientation_{"orientation", kTolerance};
  Tally halfFaces_{"halfFaces"}, isolation_{"gridCellIsolation"};
};

}  // namespace

void checkFaces(const Context& context, std::vector<Check>& checks) { FaceCheck(context).run(checks); }

}  // namespace mandoline::validation
