// Cut-faces and their two sides: planes, loops, and who owns which half-face.
#include <algorithm>

#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

struct FaceTallies {
  Tally faces{"faces"}, planarity{"planarity", kTolerance}, orientation{"orientation", kTolerance};
  Tally halfFaces{"halfFaces"}, isolation{"gridCellIsolation"};
};

/// The grid cell that a face lies in, on its axis the one above it; -1 on an axis where it is in no single one.
using FacePlace = std::array<int32_t, 3>;

FacePlace placeOf(const Context& context, size_t face) {
  FacePlace place;
  for (int d = 0; d < 3; ++d) {
    int32_t first = 0, last = INT32_MAX;  // of the grid cells that hold all vertices seen so far
    for (const std::span<const uint32_t> loop : context.cut.loops(face)) {
      for (const uint32_t v : loop) {
        first = std::max(first, context.cellAt(v)[d] - int32_t(context.onPlane(v, d)));
        last = std::min(last, context.cellAt(v)[d]);
      }
    }
    place[size_t(d)] = d == context.cut.faceAxis[face] ? context.cut.facePlane[face] : first == last ? first : -1;
  }
  return place;
}

/// Whether a face is one loop along the sides of the square, through its corners.
bool isWholeGridFace(const Context& context, size_t face, const FacePlace& place) {
  if (context.cut.loops(face).size() != 1) return false;
  const std::span<const uint32_t> loop = context.cut.loops(face)[0];
  const int e = (context.cut.faceAxis[face] + 1) % 3, g = (context.cut.faceAxis[face] + 2) % 3;
  const int32_t ce = place[size_t(e)], cg = place[size_t(g)];
  // Sides in the order of the loop; a vertex lies on those whose line its mask names.
  const auto onSide = [&](uint32_t v, int side) {
    const int axis = side % 2 == 0 ? g : e;
    const int32_t plane = side == 0 ? cg : side == 1 ? ce + 1 : side == 2 ? cg + 1 : ce;
    return context.onPlane(v, axis) && context.cellAt(v)[axis] == plane;
  };
  const auto isCorner = [&](uint32_t v, int side) { return onSide(v, side) && onSide(v, (side + 3) % 4); };  // where a side begins
  const auto start = std::find_if(loop.begin(), loop.end(), [&](uint32_t v) { return isCorner(v, 0); });
  if (start == loop.end()) return false;
  const size_t first = size_t(start - loop.begin());
  int side = 0;
  for (size_t i = 1; i <= loop.size(); ++i) {
    const uint32_t u = loop[(first + i - 1) % loop.size()], v = loop[(first + i) % loop.size()];
    if (!onSide(v, side)) return false;
    const int axis = side % 2 == 0 ? e : g, sign = side < 2 ? 1 : -1;
    if ((context.vertex(v)[axis] - context.vertex(u)[axis]) * sign < -kTolerance * context.rounding[axis]) return false;
    if (side < 4 && isCorner(v, (side + 1) % 4)) ++side;
    if (side == 4 && i < loop.size()) return false;
  }
  return side == 4;
}

/// One face by itself.
class FaceCheck {
 public:
  FaceCheck(const Context& context, FaceTallies& tallies) : x_(context), found_(tallies) {}

  void run(size_t f) {
    const FacePlace place = placeOf(x_, f);
    checkPlane(f, place);
    checkParents(f);
    checkLoops(f);
    if (x_.cut.faceAxis[f] < 0) {
      checkInnerSides(f);
    } else {
      checkAxialSides(f, place);
    }
  }

 private:
  void checkPlane(size_t f, const FacePlace& place) {
    const int axis = x_.cut.faceAxis[f];
    const int32_t plane = x_.cut.facePlane[f];
    if (*std::min_element(place.begin(), place.end()) < 0)
      return found_.isolation.violate("face", int64_t(f), "lies in several grid cells, or in an axial plane that it does not name");
    bool inPlane = true;
    if (axis >= 0) {
      for (const std::span<const uint32_t> loop : x_.cut.loops(f)) {
        for (const uint32_t v : loop) inPlane &= x_.onPlane(v, axis) && x_.cellAt(v)[axis] == plane;
      }
      for (const uint32_t t : x_.parents(f)) {
        for (int i = 0; i < 3; ++i) inPlane &= x_.corner(t, i)[axis] == x_.planes()[size_t(axis)][size_t(plane)];
      }
    }
    if (!inPlane) found_.faces.violate("face", int64_t(f), "is not in the axial plane that it names");
  }

  /// Each parent holds the face, exactly in its plane, and turns as its sign says.
  void checkParents(size_t f) {
    if (x_.parents(f).empty()) return;
    const size_t first = size_t(x_.cut.faceTriangle[f]);
    const int axis = seenAlong(first);
    const int side = x_.sideOf(first, axis);
    for (size_t i = 0; i < x_.parents(f).size(); ++i) {
      const uint32_t t = x_.parents(f)[i];
      if (x_.dropped[t]) found_.faces.violate("face", int64_t(f), "names a dropped triangle");
      if (x_.sideOf(t, axis) != x_.parentSigns(f)[i] * side)
        found_.faces.violate("face", int64_t(f), "names a triangle with the wrong sign");
      checkInTriangle(f, t);
    }
  }

  void checkInTriangle(size_t f, uint32_t t) {
    const Vec3 origin = x_.corner(t, 0);
    const Vec3 b = x_.inRoundings(x_.corner(t, 1), origin), c = x_.inRoundings(x_.corner(t, 2), origin);
    bool inPlane = true;
    for (const std::span<const uint32_t> loop : x_.cut.loops(f)) {
      for (const uint32_t v : loop) {
        const double distance = distanceToTriangle(x_.inRoundings(x_.vertex(v), origin), {}, b, c);
        found_.planarity.measure(Deviation::ofDistance(distance), "face", int64_t(f),
                                 "has a vertex that is off its triangle by {} of the largest coordinate");
        inPlane &= x_.inPlane(v, t);
      }
    }
    if (!inPlane) found_.faces.violate("face", int64_t(f), "has a vertex that does not lie exactly in the plane of its triangle");
  }

  /// The axis along which a triangle looks largest.
  int seenAlong(size_t t) const {
    const Vec3 a = x_.corner(t, 0);
    return dominantAxis(cross(x_.inRoundings(x_.corner(t, 1), a), x_.inRoundings(x_.corner(t, 2), a)));
  }

  void checkLoops(size_t f) {
    const int32_t t = x_.cut.faceTriangle[f];
    int axis = x_.cut.faceAxis[f], sign = 1;
    if (t >= 0) {
      if (axis < 0) axis = seenAlong(size_t(t));
      sign = x_.sideOf(size_t(t), axis);
    }
    bool outer = true;
    for (const std::span<const uint32_t> loop : x_.cut.loops(f)) {
      const char* text = outer ? "has an outer loop that is clockwise" : "has a hole that is not clockwise";
      const double wrong = clockwise(loop, axis, outer ? sign : -sign);
      found_.orientation.measure(Deviation::ofDistance(wrong), "face", int64_t(f), text);
      outer = false;
    }
  }

  /// By how many roundings the boundary of a loop has to move so that it no longer turns clockwise about the axis, times the sign.
  double clockwise(std::span<const uint32_t> loop, int axis, int sign) const {
    const int e = (axis + 1) % 3, g = (axis + 2) % 3;
    double area = 0, boundary = 1;  // projected along the axis
    const Vec3 first = x_.vertex(loop.back());
    Vec3 from;
    for (const uint32_t v : loop) {
      const Vec3 to = x_.inRoundings(x_.vertex(v), first);
      area += cross(from, to)[axis] / 2;
      boundary += std::fabs(to[e] - from[e]) + std::fabs(to[g] - from[g]);
      from = to;
    }
    return -sign * area / boundary;
  }

  /// A tri-face inside a grid cell: both sides belong to cut-cells.
  void checkInnerSides(size_t f) {
    if (x_.owner[2 * f] < 0 || x_.owner[2 * f + 1] < 0)
      found_.halfFaces.violate("face", int64_t(f), "lies inside a grid cell, but one side of it belongs to no cut-cell");
  }

  void checkAxialSides(size_t f, const FacePlace& place) {
    const size_t axis = size_t(x_.cut.faceAxis[f]);
    std::array<int64_t, 3> beyond{place[0], place[1], place[2]};
    if (*std::min_element(place.begin(), place.end()) < 0) return;
    if (x_.owner[2 * f] < 0 && x_.owner[2 * f + 1] < 0) return found_.halfFaces.violate("face", int64_t(f), "belongs to no cut-cell");
    const bool up = x_.axialSide(f) > 0;
    for (size_t side = 0; side < 2; ++side) {
      beyond[axis] = x_.cut.facePlane[f] - ((side == 0) == up ? 1 : 0);
      const int32_t c = x_.owner[2 * f + side];
      if (c < 0) {
        checkOpenSide(f, place, beyond);
      } else if (x_.gridCellOf(size_t(c))[axis] != beyond[axis]) {
        found_.halfFaces.violate("face", int64_t(f), "has a side that belongs to a cut-cell on the other side of its plane");
      }
    }
  }

  /// A side without cut-cell: outside the grid, or a whole grid-face before an untouched grid cell.
  void checkOpenSide(size_t f, const FacePlace& place, const std::array<int64_t, 3>& beyond) {
    const int axis = x_.cut.faceAxis[f];
    if (beyond[size_t(axis)] < 0 || beyond[size_t(axis)] >= x_.cut.grid.cells(axis)) return;
    if (x_.runAt(beyond[0], beyond[1], beyond[2]) < 0) {
      found_.halfFaces.violate("face", int64_t(f), "has a side that belongs to no cut-cell and faces no untouched grid cell");
    } else if (x_.cut.faceTriangle[f] >= 0) {
      found_.halfFaces.violate("face", int64_t(f), "is part of a triangle and faces an untouched grid cell");
    } else if (!isWholeGridFace(x_, f, place)) {
      found_.halfFaces.violate("face", int64_t(f), "faces an untouched grid cell, but is not a whole grid-face");
    }
  }

  const Context& x_;
  FaceTallies& found_;
};

void checkListings(const Context& context, Tally& tally) {
  std::vector<uint8_t> listed(2 * context.cut.faceCount(), 0);
  for (const uint32_t h : context.cut.cellHalfFaces) {
    if (listed[h] == 1) tally.violate("face", h / 2, "has a side that is listed more than once");
    if (listed[h] < 2) ++listed[h];
  }
}

bool liesInGridCell(const Context& context, size_t cell) {
  const int32_t* gridCell = context.gridCellOf(cell);
  bool inside = true;
  for (const uint32_t h : context.cut.halfFaces(cell)) {
    for (const std::span<const uint32_t> loop : context.cut.loops(h / 2)) {
      for (const uint32_t v : loop) {
        for (int d = 0; d < 3; ++d) inside &= context.inSlab(v, d, gridCell[d]);
      }
    }
  }
  return inside;
}

void checkIsolation(const Context& context, Tally& tally) {
  for (size_t c = 0; c < context.cut.cellCount(); ++c) {
    if (!liesInGridCell(context, c)) tally.violate("cell", int64_t(c), "has a vertex outside its grid cell");
  }
}

}  // namespace

FaceChecks checkFaces(const Context& context, detail::Monitor& monitor) {
  const auto parts = detail::forChunks<FaceTallies>(context.cut.faceCount(), monitor, [&](FaceTallies& tallies, size_t begin, size_t end) {
    FaceCheck check(context, tallies);
    for (size_t f = begin; f < end; ++f) check.run(f);
  });
  FaceTallies all;
  for (const FaceTallies& part : parts) {
    for (Tally FaceTallies::*tally :
         {&FaceTallies::faces, &FaceTallies::planarity, &FaceTallies::orientation, &FaceTallies::halfFaces, &FaceTallies::isolation}) {
      (all.*tally).merge(part.*tally);
    }
  }
  checkListings(context, all.halfFaces);
  checkIsolation(context, all.isolation);
  return {all.faces.finish(), all.planarity.finish(), all.orientation.finish(), all.halfFaces.finish(), all.isolation.finish()};
}

}  // namespace mandoline::validation
