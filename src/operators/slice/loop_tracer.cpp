#include "operators/slice/loop_tracer.h"

#include <tuple>
#include <utility>

#include "base/sort.h"

namespace mandoline::operators {

void LoopTracer::start(const std::vector<PlanePoint>& at) {
  at_ = &at;
  if (firstRay_.size() < at.size()) firstRay_.resize(at.size(), kNone);
}

void LoopTracer::add(uint32_t segment, uint32_t start, uint32_t end) {
  if (start == end) return;
  const uint32_t arc = uint32_t(arcs_.size());
  arcs_.push_back({segment, start, end});
  addRay(start, arc, true);
  addRay(end, arc, false);
  if (uses_.size() <= segment) uses_.resize(segment + 1, 0);
  ++uses_[segment];
}

void LoopTracer::addRay(uint32_t point, uint32_t arc, bool starts) {
  rays_.push_back({arc, starts, firstRay_[point]});
  firstRay_[point] = uint32_t(rays_.size()) - 1;
}

const detail::Csr<uint32_t>& LoopTracer::run() {
  for (const Arc& arc : arcs_) {
    if (firstRay_[arc.start] != kNone) join(arc.start);
  }
  for (detail::Csr<uint32_t>* result : {&loops_, &segments_}) {
    result->offsets.assign(1, 0);
    result->items.clear();
  }
  for (uint32_t first = 0; first < arcs_.size(); ++first) {
    if (arcs_[first].next != kNone) trace(first);
  }
  clear();
  return loops_;
}

void LoopTracer::clear() {
  for (const Arc& arc : arcs_) {
    uses_[arc.segment] = 0;
    firstRay_[arc.end] = kNone;  // where nothing starts: the arcs are not closed
  }
  arcs_.clear();
  rays_.clear();
}

/// Finds for each arc that ends in the point the one that goes on.
void LoopTracer::join(uint32_t point) {
  around_.clear();
  for (uint32_t r = std::exchange(firstRay_[point], kNone); r != kNone; r = rays_[r].next) around_.push_back(rays_[r]);
  if (around_.size() > 2) sortClockwise(point);
  // Clockwise from an arc's end its wedge comes first, up to the start of the next arc. Where rounding has put wedges into each other, they
  // are nested like parentheses; those across the start of the order are closed last.
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
    if (ended_.empty()) return;  // not a closed surface: the cut-mesh is not valid
    arcs_[ended_.back()].next = arc;
    ended_.pop_back();
  }
}

void LoopTracer::sortClockwise(uint32_t point) {
  const PlanePoint& p = (*at_)[point];
  for (Ray& ray : around_) {
    const PlanePoint& q = target(ray);
    ray.half = q == p ? 0 : q.y > p.y || (q.y == p.y && q.x > p.x) ? 1 : 2;
  }
  // In one direction, wedges without width are closed at once: they would not touch the rest. Slits have the inside on both sides: the
  // wedge before them is closed, then the one behind them opened.
  const auto rank = [&](const Ray& ray) {
    const Arc& arc = arcs_[ray.arc];
    return isSlit(arc) ? std::tuple(true, arc.segment, !ray.starts) : std::tuple(false, 0u, ray.starts);
  };
  detail::sortItems(around_, [&](const Ray& r, const Ray& s) {
    if (r.half != s.half) return r.half < s.half;
    const PlanePoint &a = target(r), &b = target(s);
    const int order = r.half == 0 ? 0 : predicates_.orient2d({p.x, p.y}, {a.x, a.y}, {b.x, b.y});
    return order != 0 ? order < 0 : rank(r) < rank(s);
  });
}

void LoopTracer::trace(uint32_t first) {
  const size_t begin = loops_.items.size();
  for (uint32_t a = first; arcs_[a].next != kNone;) {
    loops_.items.push_back(arcs_[a].start);
    segments_.items.push_back(arcs_[a].segment);
    a = std::exchange(arcs_[a].next, kNone);
  }
  const bool hasWidth = loops_.items.size() > begin + 2 || isSlit(arcs_[first]);
  for (detail::Csr<uint32_t>* result : {&loops_, &segments_}) {
    if (hasWidth) {
      result->offsets.push_back(uint32_t(result->items.size()));
    } else {
      result->items.resize(begin);
    }
  }
}

}  // namespace mandoline::operators
