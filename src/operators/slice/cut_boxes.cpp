#include "operators/slice/cut_boxes.h"

namespace mandoline::operators {
namespace {

/// The first of begin .. end - 1 for which `holds`, from which on it does for all; else end.
template <class Holds>
int32_t firstWhere(int32_t begin, int32_t end, const Holds& holds) {
  while (begin < end) {
    const int32_t middle = begin + (end - begin) / 2;
    if (holds(middle)) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin;
}

}  // namespace

CellRange CutBoxes::cutAlong(const CuttingPlane& plane, int axis, const CellBox& box) const {
  const auto corner = [&](int32_t slab, bool top) {
    ScaledPoint p;
    for (int d = 0; d < 3; ++d) {
      const CellRange range = d == axis ? CellRange{slab, slab + 1} : box[size_t(d)];
      p[size_t(d)] = grid_.planes[size_t(d)][size_t((plane.normal()[size_t(d)] > 0) == top ? range.end : range.begin)];
    }
    return p;
  };
  // With the slabs from one side of the plane to the other, their corner that is farthest that way comes across first.
  const bool up = plane.normal()[size_t(axis)] > 0;
  const auto isAcross = [&](int32_t slab, bool foremost) { return plane.isAbove(corner(slab, foremost == up)) == up; };
  const auto [begin, end] = box[size_t(axis)];
  return {firstWhere(begin, end, [&](int32_t slab) { return isAcross(slab, true); }),
          firstWhere(begin, end, [&](int32_t slab) { return isAcross(slab, false); })};
}

}  // namespace mandoline::operators
