// Points that are compared exactly. Bounds decide nearly always; of what they leave open, residues find what is 0. Where many points are so
// near to each other that the rest takes long, finer bounds decide most of it, and exact numbers what is left.
#pragma once

#include <optional>

#include "operators/validate/context.h"
#include "operators/validate/fine.h"

namespace mandoline::validation {

/// The point x / w, where w is positive.
struct ExactPoint {
  Triple<Exact> x;
  Exact w;
};

/// A vertex, a point halfway between two vertices, or where their line meets a triangle's plane.
struct Spot {
  Triple<Fine> place;
  Residues x;                                      ///< the place, times w
  Residue w;                                       ///< 0 where there are only exact numbers
  uint32_t vertex = 0;                             ///< if it has no `ends`
  std::array<const Spot*, 2> ends{};               ///< vertices, which must outlive it
  const struct FinePlane* plane = nullptr;         ///< which must outlive it, too; null: halfway
  mutable std::optional<Triple<Finest>> finest{};  ///< made when it is first needed
  mutable std::optional<ExactPoint> exact{};       ///< the same
};

/// The plane of a triangle, with a vertex near or in it from where heights are measured.
struct FinePlane {
  Triple<Bounded> normal;
  Bounded height;  ///< of the origin
  const Spot* origin;
  size_t triangle;
  PlaneOf<Fine> fine;
  bool holdsOrigin;
  mutable std::optional<PlaneOf<Exact>> exact{};  ///< made when it is first needed
};

Spot spotOf(const Context& context, uint32_t v);
/// The point halfway between two vertices.
Spot middle(const Spot& a, const Spot& b);
/// Where the line through two vertices on different sides of a plane meets it.
Spot meet(const Context& context, const Spot& a, const Spot& b, const FinePlane& plane);

FinePlane finePlane(const Context& context, size_t triangle, const Spot& origin);
/// Exact: the side of a triangle's plane that a vertex lies on, which is not in it: 1 if its normal points there.
int sideOf(const Context& context, const FinePlane& plane, const Spot& spot);
/// Exact: 1 if a, b, c turn counter-clockwise about +axis.
int turn(const Context& context, const std::array<const Spot*, 3>& spots, int axis);
/// Exact: the sign of a - b along an axis.
int compare(const Context& context, const Spot& a, const Spot& b, int axis);
/// Whether four vertices are surely not in one plane.
bool areSurelySkew(const std::array<const Spot*, 4>& spots);

}  // namespace mandoline::validation
