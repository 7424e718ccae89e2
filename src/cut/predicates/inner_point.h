// P7: predicates for nesting. A ray starts at a point inside of a triangle and runs against an axis; they tell what it meets, in which
// order. "Seen along the axis" means projected: p = axis + 1 grows to the right, q = axis + 2 upwards.
#pragma once

#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

using Corners = std::array<const Point*, 3>;  ///< of a triangle

/// The mean of a triangle's corners by positive whole-number weights, so that another can be tried if one lies unluckily.
struct InnerPoint {
  Corners corners;
  std::array<double, 3> weights;

  template <class Number>
  Number weight() const {
    return Number(weights[0] + weights[1] + weights[2]);
  }
  /// weight() times the coordinate less r.
  template <class Number>
  Number coordinate(int axis, double r) const {
    Number x = Number(weights[0]) * Number::difference((*corners[0])[axis], r);
    for (int i = 1; i < 3; ++i) x = x + Number(weights[i]) * Number::difference((*corners[i])[axis], r);
    return x;
  }
};

/// Sign of the volume inside of a closed set of triangles: positive if their normals point outwards.
int volumeSign(const std::vector<Corners>& triangles, Predicates& predicates);
/// Sign of a triangle's normal along the axis.
int normalSign(const Corners& t, int axis, Predicates& predicates);
/// 1 if the point lies inside of the triangle, seen along the axis; 0 on its outline, -1 outside.
int insideOf(const Corners& t, const InnerPoint& point, int axis, Predicates& predicates);
/// Side of the triangle's plane that the point lies on; positive where the normal points to.
int sideOfPlane(const Corners& t, const InnerPoint& point, Predicates& predicates);
/// The same for the point moved along the axis to a coordinate.
int sideOfPlane(const Corners& t, const InnerPoint& point, int axis, double coordinate, Predicates& predicates);
/// P3 on the ray: order along the axis of the places where its line meets the planes of two triangles that are not parallel to it.
int compareHeights(const Corners& t, const Corners& u, const InnerPoint& point, int axis, Predicates& predicates);
/// Whether a cut-vertex lies above the point, seen along the axis.
bool isAbove(const CutVertices& vertices, uint32_t v, const InnerPoint& point, int axis, Predicates& predicates);
/// Whether the point lies left (1) of the line from one vertex to the other or right (-1) of it, seen along the axis.
int sideOfLine(const CutVertices& vertices, const std::array<uint32_t, 2>& line, const InnerPoint& point, int axis, Predicates& predicates);

}  // namespace mandoline::detail
