#include "operators/drawing/cell_shapes.h"

#include <algorithm>
#include <cmath>

#include "operators/unit_scale.h"

namespace mandoline::drawing {

namespace {

/// A sum this much smaller than its terms together has lost the digits that a picture needs.
constexpr double kFewestDigits = 1e-9;

/// Of the pyramid over a face from the origin: six times its volume, and 24 times the integral of each coordinate.
using Moments = std::array<double, 4>;

/// Coordinates less the origin, times a power of two, so that products of four are finite.
class LocalPlaces {
 public:
  LocalPlaces(const CutMesh& cutMesh, const std::array<double, 3>& origin) : positions_(cutMesh.positions.data()) {
    double largest = 0;
    for (size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = cutMesh.grid.planes[d];
      largest = std::max({largest, std::fabs(origin[d]), std::fabs(planes.front()), std::fabs(planes.back())});
    }
    exponent_ = operators::unitExponent(largest);
    scale_ = std::ldexp(1, exponent_);
    for (size_t d = 0; d < 3; ++d) origin_[d] = scale_ * origin[d];
    double side = 0;
    for (const std::vector<double>& planes : cutMesh.grid.planes) side = std::max(side, scale_ * planes.back() - scale_ * planes.front());
    step_ = std::ldexp(1, std::ilogb(side) - 36);
  }

  std::array<double, 3> at(uint32_t vertex) const {
    const double* p = positions_ + 3 * size_t(vertex);
    return {scale_ * p[0] - origin_[0], scale_ * p[1] - origin_[1], scale_ * p[2] - origin_[2]};
  }
  double volume(double scaled) const { return std::ldexp(scaled, -3 * exponent_); }
  /// Centroids that lie in one plane must not be told apart by their last digits: rounded to a 2^-36th of the grid.
  float coordinate(double scaled) const { return float(step_ * std::floor(scaled / step_ + 0.5) / scale_); }

 private:
  const double* positions_;
  int exponent_;
  double scale_, step_;
  std::array<double, 3> origin_;
};

std::vector<Moments> faceMoments(const CutMesh& cutMesh, const FaceTriangles& faceTriangles, const LocalPlaces& places) {
  std::vector<Moments> moments(cutMesh.faceCount());
  for (size_t f = 0; f < moments.size(); ++f) {
    Moments& sum = moments[f];
    for (size_t i = 3 * size_t(faceTriangles.faceTriangleOffsets[f]); i < 3 * size_t(faceTriangles.faceTriangleOffsets[f + 1]); i += 3) {
      const auto a = places.at(faceTriangles.triangles[i]), b = places.at(faceTriangles.triangles[i + 1]),
                 c = places.at(faceTriangles.triangles[i + 2]);
      const double product = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      sum[0] += product;
      for (size_t d = 0; d < 3; ++d) sum[d + 1] += product * (a[d] + b[d] + c[d]);
    }
  }
  return moments;
}

std::array<double, 3> meanCorner(const CutMesh& cutMesh, size_t cell, const LocalPlaces& places) {
  std::array<double, 3> sum{};
  double count = 0;
  for (const uint32_t h : cutMesh.halfFaces(cell)) {
    for (const auto loop : cutMesh.loops(h / 2)) {
      for (const uint32_t v : loop) {
        const auto p = places.at(v);
        for (size_t d = 0; d < 3; ++d) sum[d] += p[d];
        ++count;
      }
    }
  }
  for (double& x : sum) x /= count;
  return sum;
}

}  // namespace

void measureCells(const CutMesh& cutMesh, const FaceTriangles& faceTriangles, const std::array<double, 3>& origin, CellDrawing& out) {
  const LocalPlaces places(cutMesh, origin);
  const std::vector<Moments> moments = faceMoments(cutMesh, faceTriangles, places);
  out.cellVolume.resize(cutMesh.cellCount());
  out.cellCentroid.resize(3 * cutMesh.cellCount());
  for (size_t cell = 0; cell < cutMesh.cellCount(); ++cell) {
    Moments sum{};
    double magnitude = 0;
    for (const uint32_t h : cutMesh.halfFaces(cell)) {
      const double sign = h % 2 ? -1 : 1;
      for (size_t i = 0; i < 4; ++i) sum[i] += sign * moments[h / 2][i];
      magnitude += std::fabs(moments[h / 2][0]);
    }
    out.cellVolume[cell] = places.volume(std::max(sum[0], 0.0) / 6);
    const bool hasDigits = sum[0] > kFewestDigits * magnitude;
    const std::array<double, 3> centroid =
        hasDigits ? std::array{sum[1] / (4 * sum[0]), sum[2] / (4 * sum[0]), sum[3] / (4 * sum[0])} : meanCorner(cutMesh, cell, places);
    for (size_t d = 0; d < 3; ++d) out.cellCentroid[3 * cell + d] = places.coordinate(centroid[d]);
  }
}

}  // namespace mandoline::drawing
