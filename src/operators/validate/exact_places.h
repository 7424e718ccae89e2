// The exact places of the vertices of a cut-mesh, as their cells, masks and parents give them. Whether one thing lies on another is decided
// by residues, on which side of it by spots (spots.h).
#pragma once

#include <array>
#include <vector>

#include "operators/validate/geometry.h"
#include "operators/validate/residue.h"

namespace mandoline::validation {

struct Context;

/// A point or vector of exact numbers, their residues, or numbers near them.
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

/// The plane of a triangle: the points p with dot(normal, p) = offset.
template <class Number>
struct PlaneOf {
  Triple<Number> normal;
  Number offset;

  bool holds(const Triple<Number>& p) const { return dot(normal, p) == offset; }
};
using ExactPlane = PlaneOf<Residue>;

/// The exact coordinates of all vertices, and the planes of all triangles.
class ExactPlaces {
 public:
  explicit ExactPlaces(const Context& context);
  const Residues& operator[](uint32_t v) const { return places_[v]; }
  /// False if the parents of v do not meet in one point.
  bool isKnown(uint32_t v) const { return known_[v] != 0; }
  const ExactPlane& planeOf(size_t triangle) const { return triPlanes_[triangle]; }
  /// 0 where that is not finite, as it may be if no triangle has it.
  const Residues& triVertex(uint32_t v) const { return triVertices_[v]; }
  const Residue& axialPlane(int axis, size_t plane) const { return axialPlanes_[size_t(axis)][plane]; }

 private:
  void convert(const Context& context);

  std::array<std::vector<Residue>, 3> axialPlanes_;
  std::vector<Residues> triVertices_;
  std::vector<ExactPlane> triPlanes_;
  std::vector<Residues> places_;
  std::vector<uint8_t> known_;
};

}  // namespace mandoline::validation
