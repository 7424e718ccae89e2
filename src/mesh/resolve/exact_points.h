// Sorting points whose approximate coordinates are too near each other to tell.
#pragma once

#include <numeric>
#include <optional>
#include <span>

#include "base/sort.h"
#include "mesh/resolve/mesh_points.h"

namespace mandoline::detail {

/// Some points. The exact coordinates of each are computed once at most, however often it is compared.
class ExactPoints {
 public:
  ExactPoints(const MeshPoints& points, std::span<const uint32_t> ids, Predicates& predicates)
      : points_(points), ids_(ids), predicates_(predicates) {}

  /// Order of the ids at two places in `ids`, along an axis.
  int compare(size_t i, size_t j, int axis) {
    const Bounded near = points_.approximate(ids_[i], axis) - points_.approximate(ids_[j], axis);
    if (near.certain()) return near.sign();
    ++predicates_.fallbacks;
    const Homogeneous<Big>&a = exact(i), &b = exact(j);
    return (a.x[axis] * b.w - b.x[axis] * a.w).sign();
  }
  /// The places in `ids`, sorted by before(i, j).
  template <class Before>
  std::vector<size_t> sorted(const Before& before) const {
    std::vector<size_t> order(ids_.size());
    std::iota(order.begin(), order.end(), size_t(0));
    sortItems(order, before);
    return order;
  }

 private:
  const Homogeneous<Big>& exact(size_t i) {
    exact_.resize(ids_.size());
    if (!exact_[i]) exact_[i] = points_.point<Big>(ids_[i], {0, 0, 0});
    return *exact_[i];
  }

  const MeshPoints& points_;
  std::span<const uint32_t> ids_;
  std::vector<std::optional<Homogeneous<Big>>> exact_;
  Predicates& predicates_;
};

}  // namespace mandoline::detail
