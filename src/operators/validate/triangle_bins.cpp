#include "operators/validate/triangle_bins.h"

#include <algorithm>

namespace mandoline::validation {

TriangleBins::TriangleBins(const Context& context) : x_(context) {
  chooseAxis();
  chooseBins();
  fill();
}

void TriangleBins::chooseAxis() {
  low_ = {{INFINITY, INFINITY, INFINITY}}, high_ = {{-INFINITY, -INFINITY, -INFINITY}};
  for (const uint32_t v : x_.mesh.triangles) {
    const Vec3 p = x_.triVertex(v);
    for (int d = 0; d < 3; ++d) low_[d] = std::min(low_[d], p[d]), high_[d] = std::max(high_[d], p[d]);
  }
  for (int d = 1; d < 3; ++d) {
    if (high_[d] - low_[d] < high_[axis_] - low_[axis_]) axis_ = d;
  }
}

/// As many as there are triangles, unless these lie in too many each.
void TriangleBins::chooseBins() {
  const size_t n = x_.mesh.triangleCount();
  const auto entries = [&] {
    for (int d = 0; d < 3; ++d) scale_[d] = high_[d] > low_[d] ? bins_ / (high_[d] - low_[d]) : 0;
    size_t count = 0;
    for (size_t t = 0; t < n; ++t) {
      const Box box = boxOf(t);
      count += (binOf(box.high, 0) - binOf(box.low, 0) + 1) * (binOf(box.high, 1) - binOf(box.low, 1) + 1);
    }
    return count;
  };
  bins_ = std::clamp(int(std::sqrt(double(n))), 1, 1024);
  while (entries() > 8 * n && bins_ > 1) bins_ /= 2;
  entries();
}

void TriangleBins::fill() {
  const size_t n = x_.mesh.triangleCount();
  offsets_.assign(size_t(bins_) * size_t(bins_) + 2, 0);  // counted two places on, so that filling leaves begins one place on
  for (size_t t = 0; t < n; ++t) forBins(t, [&](size_t b) { ++offsets_[b + 2]; });
  for (size_t b = 2; b < offsets_.size(); ++b) offsets_[b] += offsets_[b - 1];
  triangles_.resize(offsets_.back());
  for (size_t t = 0; t < n; ++t) forBins(t, [&](size_t b) { triangles_[offsets_[b + 1]++] = uint32_t(t); });
}

TriangleBins::Box TriangleBins::boxOf(size_t triangle) const {
  Box box{x_.corner(triangle, 0), x_.corner(triangle, 0)};
  for (int i = 1; i < 3; ++i) {
    const Vec3 p = x_.corner(triangle, i);
    for (int d = 0; d < 3; ++d) box.low[d] = std::min(box.low[d], p[d]), box.high[d] = std::max(box.high[d], p[d]);
  }
  return box;
}

/// How much the triangle adds to the winding number at p, if the ray meets it; nothing where rounding leaves that open.
std::optional<int32_t> TriangleBins::crossing(const Vec3& p, uint32_t triangle) const {
  const Vec3 a = x_.corner(triangle, 0), b = x_.corner(triangle, 1), c = x_.corner(triangle, 2);
  const int ab = turn(a, b, p, axis_), bc = turn(b, c, p, axis_), ca = turn(c, a, p, axis_);
  if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return 0;  // beside it
  if (ab == 0 || bc == 0 || ca == 0) return std::nullopt;
  // On which side of the triangle's plane.
  const Normal normal = normalOf(a, b, c);
  const Vec3 delta = p - a;
  const double height = dot(delta, normal.n);
  double doubt = 0;
  for (int d = 0; d < 3; ++d) doubt += std::fabs(delta[d]) * (2 * normal.error[d] + 4 * kRounding * std::fabs(normal.n[d]));
  if (std::fabs(height) <= doubt) return std::nullopt;
  return (height > 0) != (ab > 0) ? ab : 0;  // p is below: the ray leaves through a normal that points along it
}

}  // namespace mandoline::validation
