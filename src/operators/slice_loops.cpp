#include "operators/slice_loops.h"

#include <utility>

namespace mandoline::operators {

const detail::Csr<uint32_t>& SliceLoops::run(size_t cell) {
  gather(cell);
  for (const Arc& arc : arcs_) {
    if (firstRay_[end(arc, true)] != kNone) join(end(arc, true));
  }
  loops_.offsets.assign(1, 0);
  loops_.items.clear();
  for (uint32_t first = 0; first < arcs_.size(); ++first) {
    if (arcs_[first].next == kNone) continue;
    for (uint32_t a = first; arcs_[a].next != kNone;) {
      loops_.items.push_back(end(arcs_[a], true));
      a = std::exchange(arcs_[a].next, kNone);
    }
    loops_.offsets.push_back(uint32_t(loops_.items.size()));
  }
  return loops_;
}

ScaledPoint SliceLoops::tipOf(const Ray& ray) const {
  const Arc& arc = arcs_[ray.arc];
  return space_.scaled(&cutMesh_.positions[3 * size_t(segments_.segments[arc.segment].tips[ray.starts ? arc.side : 1 - arc.side])]);
}

void SliceLoops::gather(size_t cell) {
  arcs_.clear();
  rays_.clear();
  for (const uint32_t h : cutMesh_.cell(cell)) {
    for (uint32_t s = segments_.faceOffsets[h / 2]; s < segments_.faceOffsets[h / 2 + 1]; ++s) {
      arcs_.push_back({s, h % 2});
      addRay(uint32_t(arcs_.size()) - 1, true);
      addRay(uint32_t(arcs_.size()) - 1, false);
    }
  }
}

void SliceLoops::addRay(uint32_t arc, bool starts) {
  uint32_t& first = firstRay_[end(arcs_[arc], starts)];
  rays_.push_back({arc, starts, first});
  first = uint32_t(rays_.size()) - 1;
}

/// Finds for each arc that ends in the point the one that goes on.
void SliceLoops::join(uint32_t point) {
  around_.clear();
  for (uint32_t r = std::exchange(firstRay_[point], kNone); r != kNone; r = rays_[r].next) around_.push_back(rays_[r]);
  if (around_.size() > 2) sortClockwise(point);
  // Clockwise from an arc's end its wedge of the cell comes first, up to the start of the next arc. Where rounding has put wedges into
  // each other, they are nested like parentheses; those across the start of the order are closed last.
  ended_.clear();
  starting_.clear();
  for (const Ray& ray : around_) {
    if (!ray.starts) {
      ended_.push_back(ray.arc);
    } else if (ended_.empty()) {
      starting_.push_back(ray.arc);
    } else {
      arcs_[ended_.back()].next = ray.arc;
      ended_.pop_back();
    }
  }
  for (const uint32_t arc : starting_) {
    arcs_[ended_.back()].next = arc;
    ended_.pop_back();
  }
}

/// Seen along an axis: 1 if the tip lies to the left of a -> b, -1 if to the right.
int SliceLoops::sideOf(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& tip, int axis) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return predicates_.orient2d(a[p], a[q], b[p], b[q], tip[p], tip[q]);
}

/// Sorts the rays around a point as the half-planes from its edge through their tips.
void SliceLoops::sortClockwise(uint32_t point) {
  const auto [above, below] = segments_.pointEdges[point];
  const ScaledPoint a = space_.scaled(&cutMesh_.positions[3 * size_t(above)]), b = space_.scaled(&cutMesh_.positions[3 * size_t(below)]);
  int axis = 0, firstSide = 0;
  ScaledPoint first{};  // the first tip that rounding has not put onto the edge's line
  for (Ray& ray : around_) {
    ray.tip = tipOf(ray);
    for (int d = 0; d < 3 && firstSide == 0; ++d) {
      axis = d;
      first = ray.tip;
      firstSide = sideOf(a, b, first, axis);
    }
  }
  const auto turn = [&](const ScaledPoint& s, const ScaledPoint& t) { return predicates_.orient3d(a.data(), b.data(), s.data(), t.data()); };
  for (Ray& ray : around_) {  // 0: with the first one, 1: less than half a turn on, 2: opposite, 3: beyond
    const int side = turn(first, ray.tip);
    ray.quarter = side > 0 ? 1 : side < 0 ? 3 : sideOf(a, b, ray.tip, axis) * firstSide < 0 ? 2 : 0;
  }
  // The two sides of one triangle follow each other, that which closes a wedge first.
  std::sort(around_.begin(), around_.end(), [&](const Ray& r, const Ray& s) {
    if (r.quarter != s.quarter) return r.quarter < s.quarter;
    const int order = r.quarter % 2 == 1 ? turn(r.tip, s.tip) : 0;
    if (order != 0) return order > 0;
    return std::pair(arcs_[r.arc].segment, !r.starts) < std::pair(arcs_[s.arc].segment, !s.starts);
  });
}

}  // namespace mandoline::operators
