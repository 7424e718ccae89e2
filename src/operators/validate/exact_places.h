// The exact places of the vertices of a cut-mesh, as their cells, masks and parents give them. Whether one thing lies on another is decided
// by residues, on which side of it by exact numbers.
#pragma once

#include <array>
#include <vector>

#include "operators/validate/geometry.h"
#include "operators/validate/residue.h"

namespace mandoline::validation {

struct Context;

/// A point or vector of exact numbers or their residues.
template <class Number>
using Triple = std::array<Number, 3>;

template <class N>
Triple<N> operator+(const Triple<N>& a, const Triple<N>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class N>
Triple<N> operator-(const Triple<N>& a, const Triple<N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class N>
Triple<N> operator*(const N& s, const Triple<N>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class N>
N dot(const Triple<N>& a, const Triple<N>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class N>
Triple<N> cross(const Triple<N>& a, const Triple<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Residues = Triple<Residue>;
inline bool isZero(const Residues& a) { return a[0].isZero() && a[1].isZero() && a[2].isZero(); }
inline bool collinear(const Residues& a, const Residues& b, const Residues& c) { return isZero(cross(b - a, c - a)); }
inline Residues exactPlace(const Vec3& p) { return {p[0], p[1], p[2]}; }

/// The plane of a triangle: the points p with dot(normal, p) = offset.
template <class Number>
struct PlaneOf {
  Triple<Number> normal;
  Number offset;

  bool holds(const Triple<Number>& p) const { return dot(normal, p) == offset; }
};
using ExactPlane = PlaneOf<Residue>;
ExactPlane exactPlane(const Context& context, size_t triangle);

/// The exact coordinates of all vertices.
class ExactPlaces {
 public:
  explicit ExactPlaces(const Context& context);
  const Residues& operator[](uint32_t v) const { return places_[v]; }
  /// False if the parents of v do not meet in one point.
  bool isKnown(uint32_t v) const { return known_[v] != 0; }

 private:
  std::vector<Residues> places_;
  std::vector<uint8_t> known_;
};

/// The point x / w, where w is positive.
struct ExactPoint {
  Triple<Exact> x;
  Exact w;
};
/// A vertex whose place is known.
ExactPoint exactPoint(const Context& context, uint32_t v);
/// The point halfway between two points.
ExactPoint middle(const ExactPoint& a, const ExactPoint& b);
/// Where the line through two points on different sides of a triangle's plane meets it.
ExactPoint meet(const Context& context, const ExactPoint& a, const ExactPoint& b, size_t triangle);
/// The side of a triangle's plane that a point lies on: 1 if its normal points there, 0 in the plane.
int sideOf(const Context& context, const ExactPoint& p, size_t triangle);
/// 1 if a, b, c turn counter-clockwise about +axis.
int turn(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis);
/// The sign of a - b along an axis.
int compare(const ExactPoint& a, const ExactPoint& b, int axis);

}  // namespace mandoline::validation
