// P7: predicates for nesting. A ray starts at a point inside of a tri-cut-face and runs against an axis; they tell what it meets, in which
// order. "Seen along the axis" means projected: p = axis + 1 grows to the right, q = axis + 2 upwards.
#pragma once

#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

/// The mean of three cut-vertices by positive whole-number weights, so that another can be tried if a ray from one grazes something.
struct InnerPoint {
  std::array<VertexId, 3> corners;
  std::array<double, 3> weights;
};

/// Its coordinates as doubles.
std::array<Bounded, 3> approximate(const CutVertices& vertices, const InnerPoint& point, Predicates& predicates);
/// Where the ray's line meets a triangle's plane, as a double along the axis.
Bounded approximateHeight(const CutVertices& vertices, TriangleId triangle, const InnerPoint& point, int axis, Predicates& predicates);
/// P3 on the ray: order along the axis of the places where its line meets the planes of two triangles that are not parallel to it.
int compareHeights(const CutVertices& vertices, const std::array<TriangleId, 2>& triangles, const InnerPoint& point, int axis,
                   Predicates& predicates);
/// Whether a cut-vertex lies above the point, seen along the axis.
bool isAbove(const CutVertices& vertices, VertexId v, const InnerPoint& point, int axis, Predicates& predicates);
/// Whether the point lies left (1) of the line from one vertex to the other or right (-1) of it, seen along the axis.
int sideOfLine(const CutVertices& vertices, const std::array<VertexId, 2>& line, const InnerPoint& point, int axis, Predicates& predicates);

}  // namespace mandoline::detail
