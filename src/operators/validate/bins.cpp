// Finds the input's triangles near a point or above it.
#include "operators/validate/bins.h"

#include <algorithm>

namespace mandoline::validation {

TriangleBins::TriangleBins(const Context& context) : x_(context) {
  const size_t n = x_.mesh.triangleCount();
  Vec3 high;
  low_ = {{INFINITY, INFINITY, INFINITY}}, high = {{-INFINITY, -INFINITY, -INFINITY}};
  for (const uint32_t v : x_.mesh.triangles) {
    for (int d = 0; d < 3; ++d) low_[d] = std::min(low_[d], x_.triVertex(v)[d]), high[d] = std::max(high[d], x_.triVertex(v)[d]);
  }
  for (int d = 1; d < 3; ++d) {
    if (high[d] - low_[d] < high[axis_] - low_[axis_]) axis_ = d;
  }
  const auto entries = [&] {
    for (int d = 0; d < 3; ++d) scale_[d] = high[d] > low_[d] ? bins_ / (high[d] - low_[d]) : 0;
    size_t count = 0;
    for (size_t t = 0; t < n; ++t) {
      Vec3 a, b;
      box(t, a, b);
      count += (binOf(b, 0) - binOf(a, 0) + 1) * (binOf(b, 1) - binOf(a, 1) + 1);
    }
    return count;
  };
  bins_ = std::clamp(int(std::sqrt(double(n))), 1, 1024);
  while (entries() > 8 * n && bins_ > 1) bins_ /= 2;
  entries();

  offsets_.assign(size_t(bins_) * bins_ + 2, 0);  // counted two places on, so that filling leaves begins one place on
  const auto forBins = [&](size_t t, auto&& use) {
    Vec3 a, b;
    box(t, a, b);
    for (size_t j = binOf(a, 1); j <= binOf(b, 1); ++j) {
      for (size_t i = binOf(a, 0); i <= binOf(b, 0); ++i) use(j * size_t(bins_) + i);
    }
  };
  for (size_t t = 0; t < n; ++t) forBins(t, [&](size_t b) { ++offsets_[b + 2]; });
  for (size_t b = 2; b < offsets_.size(); ++b) offsets_[b] += offsets_[b - 1];
  triangles_.resize(offsets_.back());
  for (size_t t = 0; t < n; ++t) forBins(t, [&](size_t b) { triangles_[offsets_[b + 1]++] = uint32_t(t); });
}

void TriangleBins::box(size_t triangle, Vec3& low, Vec3& high) const {
  low = high = x_.corner(triangle, 0);
  for (int i = 1; i < 3; ++i) {
    const Vec3 p = x_.corner(triangle, i);
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  }
}

bool TriangleBins::winding(const Vec3& p, bool withDuplicates, int32_t& result) const {
  bool certain = true;
  result = 0;
  forTriangles(p, p, [&](uint32_t t) {
    if (!certain || (!withDuplicates && x_.isDuplicate(t))) return;
    const Vec3 a = x_.corner(t, 0), b = x_.corner(t, 1), c = x_.corner(t, 2);
    const int ab = turn(a, b, p, axis_), bc = turn(b, c, p, axis_), ca = turn(c, a, p, axis_);
    if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return;  // beside it
    if (ab == 0 || bc == 0 || ca == 0) {
      certain = false;
      return;
    }
    // On which side of the triangle's plane; the corner closest along the axis keeps the error small.
    const Normal normal = normalOf(a, b, c);
    const Vec3 delta = p - a;
    const double height = dot(delta, normal.n);
    double doubt = 0;
    for (int d = 0; d < 3; ++d) doubt += std::fabs(delta[d]) * (2 * normal.error[d] + 4 * kRounding * std::fabs(normal.n[d]));
    if (std::fabs(height) <= doubt) {
      certain = false;
      return;
    }
    if ((height > 0) != (ab > 0)) result += ab;  // p is below: the ray leaves through a normal that points along it
  });
  return certain;
}

}  // namespace mandoline::validation
