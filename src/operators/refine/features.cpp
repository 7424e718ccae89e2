#include "operators/refine/features.h"

#include <algorithm>
#include <cmath>

#include "operators/degrees.h"
#include "operators/measure/vector.h"

namespace mandoline::refining {

using measuring::cross;
using measuring::difference;
using measuring::dot;
using Vector = measuring::Vector<double>;

Features::Features(const MeshView& mesh, double angle) : mesh_(mesh), angle_(angle), cosine_(operators::cosineOfDegrees(angle)) {}

namespace {

std::array<Vector, 3> cornersOf(const MeshView& mesh, uint32_t triangle) {
  std::array<Vector, 3> corners;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t d = 0; d < 3; ++d) corners[i][d] = mesh.positions[3 * size_t(mesh.triangles[3 * size_t(triangle) + i]) + d];
  }
  return corners;
}

Vector unitNormal(const MeshView& mesh, uint32_t triangle) {
  const auto [a, b, c] = cornersOf(mesh, triangle);
  Vector ab = difference(b, a), ac = difference(c, a);
  double largest = 0;
  for (size_t d = 0; d < 3; ++d) largest = std::max({largest, std::fabs(ab[d]), std::fabs(ac[d])});
  if (!(largest > 0)) return {};
  for (size_t d = 0; d < 3; ++d) ab[d] /= largest, ac[d] /= largest;
  Vector normal = cross(ab, ac);
  const double length = measuring::length(normal);
  for (double& x : normal) x = length > 0 ? x / length : 0;
  return normal;
}

}  // namespace

/// Looks at the normal that is farthest from the first, and at that farthest from it: on curved and bent surfaces the largest angle.
bool Features::bends(const std::vector<uint32_t>& triangles) const {
  if (angle_ == 0) return !triangles.empty();
  const auto farthest = [&](const Vector& from) {
    Vector least = from;
    double cosine = 2;
    for (const uint32_t t : triangles) {
      const Vector normal = unitNormal(mesh_, t);
      if (dot(normal, normal) > 0 && dot(normal, from) < cosine) cosine = dot(normal, from), least = normal;
    }
    return least;
  };
  if (triangles.size() < 2) return false;
  const Vector a = farthest(unitNormal(mesh_, triangles[0])), b = farthest(a);
  constexpr double kRounding = 1e-9;
  return dot(a, b) < cosine_ - kRounding;
}

/// By the axes that may separate a box from a triangle (Akenine-Moeller 2001).
std::vector<uint32_t> Features::meeting(const Box& box, const std::vector<uint32_t>& triangles) const {
  Vector middle, half;
  for (size_t d = 0; d < 3; ++d) middle[d] = box.low[d] / 2 + box.high[d] / 2, half[d] = box.high[d] / 2 - box.low[d] / 2;
  std::vector<uint32_t> result;
  for (const uint32_t t : triangles) {
    std::array<Vector, 3> p = cornersOf(mesh_, t);
    for (Vector& corner : p) corner = difference(corner, middle);
    const auto separates = [&](const Vector& axis) {
      const double along[] = {dot(p[0], axis), dot(p[1], axis), dot(p[2], axis)};
      const double reach = half[0] * std::fabs(axis[0]) + half[1] * std::fabs(axis[1]) + half[2] * std::fabs(axis[2]);
      return std::min({along[0], along[1], along[2]}) > reach || std::max({along[0], along[1], along[2]}) < -reach;
    };
    const std::array<Vector, 3> sides = {difference(p[1], p[0]), difference(p[2], p[1]), difference(p[0], p[2])};
    bool apart = separates(cross(sides[0], sides[1]));
    for (size_t d = 0; d < 3 && !apart; ++d) {
      const Vector axis = {double(d == 0), double(d == 1), double(d == 2)};
      apart = separates(axis);
      for (size_t i = 0; i < 3 && !apart; ++i) apart = separates(cross(axis, sides[i]));
    }
    if (!apart) result.push_back(t);
  }
  return result;
}

}  // namespace mandoline::refining
