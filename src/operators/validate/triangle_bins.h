// The input's triangles by place, to find those near a point or above it.
#pragma once

#include <optional>

#include "operators/validate/context.h"

namespace mandoline::validation {

/// The bin of a coordinate in bins from 0.
inline size_t binIndex(double x, int bins) { return x >= bins - 1 ? size_t(bins - 1) : x > 0 ? size_t(x) : 0; }

/// The input's triangles in square bins, seen along the axis in which the mesh is thinnest.
class TriangleBins {
 public:
  explicit TriangleBins(const Context& context);
  /// f(triangle) for all triangles in the bins of a box, some of them repeatedly.
  template <class F>
  void forTriangles(const Vec3& low, const Vec3& high, F&& f) const {
    for (size_t j = binOf(low, 1); j <= binOf(high, 1); ++j) {
      for (size_t b = j * size_t(bins_) + binOf(low, 0); b <= j * size_t(bins_) + binOf(high, 0); ++b) {
        for (uint32_t i = offsets_[b]; i < offsets_[b + 1]; ++i) f(triangles_[i]);
      }
    }
  }
  /// Winding number of the input at a point, by a ray along the axis; none where rounding leaves it open. Of those triangles that
  /// `counts(triangle)`.
  template <class Counts>
  std::optional<int32_t> winding(const Vec3& p, const Counts& counts) const {
    std::optional<int32_t> sum = 0;
    forTriangles(p, p, [&](uint32_t t) {
      if (!sum || !counts(t)) return;
      const std::optional<int32_t> step = crossing(p, t);
      sum = step ? std::optional(*sum + *step) : std::nullopt;
    });
    return sum;
  }

 private:
  struct Box {
    Vec3 low, high;
  };

  size_t binOf(const Vec3& p, int side) const {
    const int d = (axis_ + 1 + side) % 3;
    return binIndex((p[d] - low_[d]) * scale_[d], bins_);
  }
  Box boxOf(size_t triangle) const;
  /// f(bin) for the bins of a triangle.
  template <class F>
  void forBins(size_t triangle, F&& f) const {
    const Box box = boxOf(triangle);
    for (size_t j = binOf(box.low, 1); j <= binOf(box.high, 1); ++j) {
      for (size_t i = binOf(box.low, 0); i <= binOf(box.high, 0); ++i) f(j * size_t(bins_) + i);
    }
  }
  void chooseAxis();
  void chooseBins();
  void fill();
  std::optional<int32_t> crossing(const Vec3& p, uint32_t triangle) const;

  const Context& x_;
  int axis_ = 0, bins_ = 1;
  Vec3 low_, high_, scale_;
  std::vector<uint32_t> offsets_, triangles_;
};

}  // namespace mandoline::validation
