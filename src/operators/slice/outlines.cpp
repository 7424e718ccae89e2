#include <cmath>

#include "mandoline/slice.h"
#include "operators/slice/outline_writer.h"

namespace mandoline {

std::vector<Outlines> outlines(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets) {
  using namespace operators;
  const PlanarCuts cuts(cutMesh, normal, offsets);
  RegionArcs arcs(cutMesh, cuts);
  Points points;
  OutlineWriter writer(cuts.space);
  std::vector<Outlines> result(offsets.size());
  for (uint32_t p = 0; p < cuts.planes.size(); ++p) {
    points.start(cuts.planes[p]);
    const std::vector<RegionArc>& cut = arcs.run(p, points);
    writer.run(cut, points, result[cuts.planes.given(p)]);
  }
  return result;
}

Outlines outlines(const CutMesh& cutMesh, const Plane& plane) { return std::move(outlines(cutMesh, plane.normal, {&plane.offset, 1})[0]); }

PlaneAxes planeAxes(const std::array<double, 3>& normal) {
  operators::requireNormal(normal);
  const auto unit = [](std::array<double, 3> v) {
    double largest = 0, sum = 0;
    for (const double x : v) largest = std::max(largest, std::fabs(x));
    for (double& x : v) {
      x /= largest;
      sum += x * x;
    }
    for (double& x : v) x = x / std::sqrt(sum) + 0.0;  // no negative zero
    return v;
  };
  const std::array<double, 3> up = unit(normal);
  size_t steepest = 0;
  for (size_t d = 1; d < 3; ++d) {
    if (std::fabs(up[d]) > std::fabs(up[steepest])) steepest = d;
  }
  const size_t towards = (steepest + (up[steepest] > 0 ? 1 : 2)) % 3;  // as the plane is seen along that axis
  PlaneAxes axes;
  for (size_t d = 0; d < 3; ++d) axes.right[d] = (d == towards ? 1 : 0) - up[towards] * up[d];
  axes.right = unit(axes.right);
  for (size_t d = 0; d < 3; ++d) {
    const size_t e = (d + 1) % 3, f = (d + 2) % 3;
    axes.up[d] = up[e] * axes.right[f] - up[f] * axes.right[e] + 0.0;
  }
  return axes;
}

}  // namespace mandoline
