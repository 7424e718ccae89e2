#include "operators/drawing/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/csr.h"
#include "base/position_table.h"
#include "operators/measure/vector.h"
#include "operators/unit_scale.h"

namespace mandoline::drawing {

namespace {

using measuring::cross;
using measuring::difference;
using measuring::dot;
using Vector = measuring::Vector<double>;

/// The cosine of the sharpest bend that is smoothed, 45 degrees.
constexpr double kSharpest = 0.70710678118654752;
/// A corner where more triangles meet keeps its triangle's normal: a fan's apex has none that is better, and the work grows with the
/// square.
constexpr size_t kMostAround = 64;
/// Sums of differences of bytes below this are small.
constexpr int kAlike = 24;

/// A mesh scaled by a power of two, so that products of its coordinates are finite.
class ScaledMesh {
 public:
  explicit ScaledMesh(const MeshView& mesh) : mesh_(mesh) {
    double largest = 0;
    for (const double x : mesh.positions) largest = std::max(largest, std::fabs(x));
    scale_ = std::ldexp(1, operators::unitExponent(largest));
  }

  uint32_t vertex(size_t corner) const { return mesh_.triangles[corner]; }
  Vector at(size_t corner) const { return place(&mesh_.positions[3 * size_t(vertex(corner))]); }
  Vector place(const double* p) const { return {scale_ * p[0], scale_ * p[1], scale_ * p[2]}; }

 private:
  const MeshView& mesh_;
  double scale_;
};

struct Facets {
  std::vector<Vector> normals;  ///< per triangle: unit; 0 without area
  std::vector<double> weights;  ///< per corner: how much its triangle counts there
};

/// Weights are those of Max (Weights for Computing Vertex Normals from Facet Normals, 1999), exact on spheres: sine of the angle over the
/// lengths of its sides.
Facets facetsOf(const MeshView& mesh, const ScaledMesh& scaled) {
  Facets facets{std::vector<Vector>(mesh.triangleCount()), std::vector<double>(mesh.triangles.size())};
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Vector corners[3] = {scaled.at(3 * t), scaled.at(3 * t + 1), scaled.at(3 * t + 2)};
    double squares[3];  // of the side that begins at each corner
    for (size_t k = 0; k < 3; ++k) {
      const Vector side = difference(corners[(k + 1) % 3], corners[k]);
      squares[k] = dot(side, side);
    }
    const Vector normal = cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
    const double doubleArea = std::sqrt(dot(normal, normal));
    if (doubleArea == 0) continue;
    for (size_t d = 0; d < 3; ++d) facets.normals[t][d] = normal[d] / doubleArea;
    for (size_t k = 0; k < 3; ++k) {
      const double sides = squares[k] * squares[(k + 2) % 3];
      facets.weights[3 * t + k] = sides > 0 ? doubleArea / sides : 0;
    }
  }
  return facets;
}

/// Unit normals at the corners of triangles, on the side of the triangle's own normal; 0 where it has no area.
std::vector<Vector> cornerNormals(const MeshView& mesh, const ScaledMesh& scaled) {
  const auto at = [&](uint32_t v) { return &mesh.positions[3 * size_t(v)]; };
  // Files often have vertices for each triangle.
  const std::vector<uint32_t> welded = detail::lowestAtPosition(mesh.vertexCount(), at, [](uint32_t) { return true; });
  const size_t corners = mesh.triangles.size();
  const auto around = detail::groupBy<uint32_t>(
      mesh.vertexCount(), corners, [&](size_t corner) { return size_t(welded[scaled.vertex(corner)]); },
      [](size_t corner) { return uint32_t(corner); });
  const Facets facets = facetsOf(mesh, scaled);
  std::vector<Vector> normals(corners);
  for (size_t corner = 0; corner < corners; ++corner) {
    const Vector own = facets.normals[corner / 3];
    const auto others = around[welded[scaled.vertex(corner)]];
    Vector sum{};
    for (size_t i = 0; i < others.size() && others.size() <= kMostAround; ++i) {
      const Vector normal = facets.normals[others[i] / 3];
      const double cosine = dot(own, normal);
      if (std::fabs(cosine) < kSharpest) continue;
      // A neighbour that is oriented the other way round bends as little.
      const double weight = cosine < 0 ? -facets.weights[others[i]] : facets.weights[others[i]];
      for (size_t d = 0; d < 3; ++d) sum[d] += weight * normal[d];
    }
    const double length = measuring::length(sum);
    for (size_t d = 0; d < 3; ++d) normals[corner][d] = length > 0 && std::isfinite(length) ? sum[d] / length : own[d];
  }
  return normals;
}

PackedNormal packed(const Vector& normal) {
  const double length = std::sqrt(dot(normal, normal));
  const bool hasDirection = length > 0 && std::isfinite(length);
  const auto byte = [&](size_t d) { return hasDirection ? uint32_t(uint8_t(int8_t(std::floor(127 / length * normal[d] + 0.5)))) : 0; };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | uint32_t(1) << 24;
}

/// Interpolates between the normals at a triangle's corners, as seen along the axis along which it is seen largest.
class Interpolation {
 public:
  Interpolation(const ScaledMesh& mesh, const std::vector<Vector>& normals, size_t triangle)
      : mesh_(mesh), normals_(&normals[3 * triangle]), a_(mesh.at(3 * triangle)) {
    b_ = difference(mesh.at(3 * triangle + 1), a_);
    c_ = difference(mesh.at(3 * triangle + 2), a_);
    const Vector normal = cross(b_, c_);
    const size_t across = size_t(measuring::largestAxis(normal));
    u_ = (across + 1) % 3;
    v_ = (across + 2) % 3;
    area_ = normal[across];
  }

  PackedNormal at(const double* position) const {
    const Vector p = difference(mesh_.place(position), a_);
    const double ofB = area_ == 0 ? 0 : std::clamp((p[u_] * c_[v_] - p[v_] * c_[u_]) / area_, 0.0, 1.0);
    const double ofC = area_ == 0 ? 0 : std::clamp((b_[u_] * p[v_] - b_[v_] * p[u_]) / area_, 0.0, 1 - ofB);
    Vector normal;
    for (size_t d = 0; d < 3; ++d) normal[d] = (1 - ofB - ofC) * normals_[0][d] + ofB * normals_[1][d] + ofC * normals_[2][d];
    return packed(normal);
  }

 private:
  const ScaledMesh& mesh_;
  const Vector* normals_;
  Vector a_, b_, c_;
  size_t u_, v_;
  double area_;
};

}  // namespace

bool areAlike(PackedNormal a, PackedNormal b) {
  int sum = 0;
  for (int shift = 0; shift < 24; shift += 8) sum += std::abs(int(int8_t(a >> shift)) - int(int8_t(b >> shift)));
  return sum < kAlike;
}

std::vector<PackedNormal> faceNormals(const MeshView& mesh, const CutMesh& cutMesh) {
  const ScaledMesh scaled(mesh);
  const std::vector<Vector> corners = cornerNormals(mesh, scaled);
  std::vector<PackedNormal> normals(cutMesh.loopVertices.size(), 0);
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    if (cutMesh.faceTriangle[f] < 0) continue;
    const Interpolation interpolation(scaled, corners, size_t(cutMesh.faceTriangle[f]));
    const uint32_t begin = cutMesh.loopOffsets[cutMesh.faceLoopOffsets[f]], end = cutMesh.loopOffsets[cutMesh.faceLoopOffsets[f + 1]];
    for (uint32_t i = begin; i < end; ++i) normals[i] = interpolation.at(&cutMesh.positions[3 * size_t(cutMesh.loopVertices[i])]);
  }
  return normals;
}

}  // namespace mandoline::drawing
