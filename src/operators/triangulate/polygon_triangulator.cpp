// Triangulation (paper, 4.7) by ear clipping, for convex tri-faces and for grid-faces with holes alike.
//
// A polygon's loops are joined into one cyclic chain of corners: loops that share a vertex are spliced there, the others are joined by
// bridges (edges run through in both directions). Then ears are clipped off: a chain of n corners gives n - 2 triangles. So whatever the
// coordinates are, the triangles use the directed edges of the loops once and every other edge once in each direction: geometry only
// chooses. It chooses by exact signs of the rounded positions: a face whose rounded loops don't cross gets triangles of positive area.
// Where rounding has made a face overlap itself or vanish, the least bad ear is clipped; where that would be a triangle with a vertex
// twice, its two other edges, which are opposite, cancel instead.
#include "operators/triangulate/polygon_triangulator.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/double_double.h"

namespace mandoline::operators {
namespace {

using detail::DoubleDouble;
using detail::twoProduct;
using detail::twoSum;
using Point = PlanePoint;

double squaredDistance(const Point& a, const Point& b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }

/// Exact sign of the triangle's area: the sum of six products, grown to an expansion (Shewchuk 1997).
double exactOrientation(const Point& a, const Point& b, const Point& c) {
  const DoubleDouble products[6] = {twoProduct(a.x, b.y),  twoProduct(-a.y, b.x), twoProduct(b.x, c.y),
                                    twoProduct(-b.y, c.x), twoProduct(c.x, a.y),  twoProduct(-c.y, a.x)};
  double terms[12];
  int count = 0;
  for (const DoubleDouble& product : products) {
    for (double carry : {product.low, product.high}) {
      for (int i = 0; i < count; ++i) {
        const DoubleDouble sum = twoSum(carry, terms[i]);
        terms[i] = sum.low;
        carry = sum.high;
      }
      terms[count++] = carry;
    }
  }
  while (count > 0 && terms[count - 1] == 0) --count;
  return count > 0 ? terms[count - 1] : 0;
}

/// Twice the triangle's area with an exact sign; positive when a, b, c turn counter-clockwise.
double orientation(const Point& a, const Point& b, const Point& c) {
  constexpr double kErrorBound = (3 + 16 * 0x1p-53) * 0x1p-53;
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), area = left - right;
  return std::fabs(area) >= kErrorBound * (std::fabs(left) + std::fabs(right)) ? area : exactOrientation(a, b, c);
}

constexpr uint32_t kNone = ~0u;

/// A place on a chain. A vertex may have several.
struct Corner {
  Point at;
  uint32_t vertex, previous, next;
  uint32_t version = 0;           ///< that of its last entry in the heap
  uint32_t firstWatcher = kNone;  ///< ears to look at again when this corner is gone
  bool alive = true;
};

/// Finds living corners in a box: a k-d tree without pointers, the middle of each range being its node.
class CornerTree {
 public:
  void build(const std::vector<Corner>& corners) {
    order_.clear();
    for (uint32_t i = 0; i < corners.size(); ++i) order_.push_back(i);
    split(corners, 0, uint32_t(order_.size()), 0);
    slot_.resize(order_.size());
    living_.resize(order_.size());
    for (uint32_t s = 0; s < order_.size(); ++s) slot_[order_[s]] = s;
    countLiving(0, uint32_t(order_.size()));
  }

  void remove(uint32_t corner) {
    uint32_t begin = 0, end = uint32_t(order_.size());
    for (;;) {
      const uint32_t middle = begin + (end - begin) / 2;
      --living_[middle];
      if (middle == slot_[corner]) return;
      (slot_[corner] < middle ? end : begin) = slot_[corner] < middle ? middle : middle + 1;
    }
  }

  /// The first corner in the box that `blocks`, or kNone.
  template <class Blocks>
  uint32_t find(const std::vector<Corner>& corners, const Point& low, const Point& high, const Blocks& blocks) const {
    return findIn(corners, 0, uint32_t(order_.size()), 0, low, high, blocks);
  }

 private:
  static double coordinate(const Point& p, int axis) { return axis == 0 ? p.x : p.y; }

  void split(const std::vector<Corner>& corners, uint32_t begin, uint32_t end, int axis) {
    if (end - begin < 2) return;
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](uint32_t a, uint32_t b) {
      const double x = coordinate(corners[a].at, axis), y = coordinate(corners[b].at, axis);
      return x != y ? x < y : a < b;
    });
    split(corners, begin, middle, 1 - axis);
    split(corners, middle + 1, end, 1 - axis);
  }

  uint32_t countLiving(uint32_t begin, uint32_t end) {
    if (begin == end) return 0;
    const uint32_t middle = begin + (end - begin) / 2;
    return living_[middle] = 1 + countLiving(begin, middle) + countLiving(middle + 1, end);
  }

  template <class Blocks>
  uint32_t findIn(const std::vector<Corner>& corners, uint32_t begin, uint32_t end, int axis, const Point& low, const Point& high,
                  const Blocks& blocks) const {
    if (begin == end) return kNone;
    const uint32_t middle = begin + (end - begin) / 2, corner = order_[middle];
    if (living_[middle] == 0) return kNone;
    const Point& p = corners[corner].at;
    if (corners[corner].alive && low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && blocks(corner)) return corner;
    uint32_t found = kNone;
    if (coordinate(low, axis) <= coordinate(p, axis)) found = findIn(corners, begin, middle, 1 - axis, low, high, blocks);
    if (found == kNone && coordinate(p, axis) <= coordinate(high, axis))
      found = findIn(corners, middle + 1, end, 1 - axis, low, high, blocks);
    return found;
  }

  std::vector<uint32_t> order_, slot_;
  std::vector<uint32_t> living_;  // per slot: living corners in the range that it is the middle of
};

}  // namespace

class PolygonTriangulator::Implementation {
 public:
  void startLoop() {
    closeLoop();
    loopFirst_.push_back(uint32_t(corners_.size()));
  }
  void addCorner(uint32_t vertex, const Point& at) {
    const uint32_t i = uint32_t(corners_.size());
    corners_.push_back({at, vertex, i - 1, i + 1});
  }
  void run(std::vector<uint32_t>& triangles) {
    triangles_ = &triangles;
    closeLoop();
    if (corners_.size() >= 3) {
      if (loopFirst_.size() > 1) joinLoops();
      if (!clipFan()) clipEars();
    }
    corners_.clear();
    loopFirst_.clear();
  }

 private:
  struct HeapEntry {
    double key;  // squared length of the edge that the ear leaves
    uint32_t corner, version;
    bool operator<(const HeapEntry& other) const {  // the heap's top is the largest
      return std::tie(key, corner, version) > std::tie(other.key, other.corner, other.version);
    }
  };
  struct Watcher {
    uint32_t corner, version, next;
  };

  void closeLoop() {
    if (loopFirst_.empty()) return;
    if (loopFirst_.back() == corners_.size()) return loopFirst_.pop_back();
    link(uint32_t(corners_.size()) - 1, loopFirst_.back());
  }

  const Point& at(uint32_t i) const { return corners_[i].at; }
  uint32_t previous(uint32_t i) const { return corners_[i].previous; }
  uint32_t next(uint32_t i) const { return corners_[i].next; }
  double turn(uint32_t a, uint32_t b, uint32_t c) const { return orientation(at(a), at(b), at(c)); }
  void link(uint32_t a, uint32_t b) {
    corners_[a].next = b;
    corners_[b].previous = a;
  }
  template <class F>
  void forChain(uint32_t first, const F& f) const {
    uint32_t i = first;
    do {
      f(i);
      i = next(i);
    } while (i != first);
  }

  // ---- Joining the loops

  uint32_t chainOf(uint32_t loop) {
    while (chain_[loop] != loop) loop = chain_[loop] = chain_[chain_[loop]];
    return loop;
  }
  uint32_t loopOf(uint32_t corner) const {
    return uint32_t(std::upper_bound(loopFirst_.begin(), loopFirst_.end(), corner) - loopFirst_.begin()) - 1;
  }
  void uniteChains(uint32_t a, uint32_t b) { chain_[std::max(a, b)] = std::min(a, b); }

  /// Whether the inside of the face at a corner, the wedge to the left of its two edges, opens towards a point.
  bool opensTowards(uint32_t corner, const Point& p) const {
    const uint32_t before = previous(corner), after = next(corner);
    const bool leftOfNext = orientation(at(corner), at(after), p) > 0, leftOfPrevious = orientation(at(corner), p, at(before)) > 0;
    return turn(before, corner, after) > 0 ? leftOfNext && leftOfPrevious : leftOfNext || leftOfPrevious;
  }

  void joinLoops() {
    chain_.resize(loopFirst_.size());
    for (uint32_t l = 0; l < chain_.size(); ++l) chain_[l] = l;
    spliceSharedVertices();
    bridgeHoles();
  }

  void spliceSharedVertices() {
    shared_.clear();
    for (uint32_t i = 0; i < corners_.size(); ++i) shared_.push_back(i);
    std::sort(shared_.begin(), shared_.end(),
              [&](uint32_t a, uint32_t b) { return std::tie(corners_[a].vertex, a) < std::tie(corners_[b].vertex, b); });
    for (size_t begin = 0, end; begin < shared_.size(); begin = end) {
      end = begin + 1;
      while (end < shared_.size() && corners_[shared_[end]].vertex == corners_[shared_[begin]].vertex) ++end;
      if (end - begin > 1) {
        splice(begin, end, true);
        splice(begin, end, false);
      }
    }
  }

  /// Splices the chains that meet in a vertex, at corners that open towards each other if wanted.
  void splice(size_t begin, size_t end, bool open) {
    for (size_t i = begin; i < end; ++i) {
      for (size_t j = begin; j < end; ++j) {
        const uint32_t a = shared_[i], b = shared_[j], chainA = chainOf(loopOf(a)), chainB = chainOf(loopOf(b));
        if (chainA == chainB || (open && !opensTowards(a, at(next(b))))) continue;
        const uint32_t afterA = next(a);
        link(a, next(b));
        link(b, afterA);
        uniteChains(chainA, chainB);
      }
    }
  }

  /// Holes from left to right, so that each finds all to its left in one chain with the outer loop.
  void bridgeHoles() {
    holes_.clear();
    for (uint32_t l = 1; l < loopFirst_.size(); ++l) {
      if (chainOf(l) != l) continue;
      uint32_t leftmost = loopFirst_[l];
      forChain(loopFirst_[l], [&](uint32_t i) {
        if (std::tie(at(i).x, at(i).y) < std::tie(at(leftmost).x, at(leftmost).y)) leftmost = i;
      });
      holes_.push_back(leftmost);
    }
    std::sort(holes_.begin(), holes_.end(),
              [&](uint32_t a, uint32_t b) { return std::tie(at(a).x, at(a).y, a) < std::tie(at(b).x, at(b).y, b); });
    for (const uint32_t hole : holes_) {
      const uint32_t end = visibleFrom(hole);
      uint32_t start = hole;
      forChain(hole, [&](uint32_t i) {
        if (at(i) == at(hole) && !opensTowards(start, at(end)) && opensTowards(i, at(end))) start = i;
      });
      bridge(end, start);
    }
  }

  void bridge(uint32_t a, uint32_t b) {
    const uint32_t a2 = uint32_t(corners_.size()), b2 = a2 + 1, afterA = next(a), beforeB = previous(b);
    corners_.push_back({at(a), corners_[a].vertex, kNone, kNone});
    corners_.push_back({at(b), corners_[b].vertex, kNone, kNone});
    link(a, b);
    link(beforeB, b2);
    link(b2, a2);
    link(a2, afterA);
  }

  /// A corner of the outer loop's chain that is visible from the leftmost corner of a hole (Eberly, "Triangulation by Ear Clipping"): the
  /// ray to the left meets an edge; turned towards that edge's left end, it meets a corner, no later than the end.
  uint32_t visibleFrom(uint32_t hole) const {
    const Point m = at(hole);
    const uint32_t edge = edgeLeftOf(m);
    if (edge == kNone) return nearestTo(m);
    const bool upwards = at(edge).x < at(next(edge)).x;
    const double sense = upwards ? 1 : -1;
    uint32_t best = upwards ? edge : next(edge);
    forChain(loopFirst_[0], [&](uint32_t i) {
      const Point& p = at(i);
      if (!(p.x < m.x) || sense * (p.y - m.y) < 0 || orientation(at(edge), at(next(edge)), p) < 0) return;
      const double nearer = sense * orientation(m, at(best), p);
      if (nearer > 0 || (nearer == 0 && (p.x > at(best).x || (p == at(best) && !opensTowards(best, m) && opensTowards(i, m))))) best = i;
    });
    return best;
  }

  /// The edge of the outer loop's chain that a ray to the left meets first, by its start, the upper end; kNone if rounding has left none.
  uint32_t edgeLeftOf(const Point& m) const {
    uint32_t best = kNone;
    forChain(loopFirst_[0], [&](uint32_t i) {
      const Point &a = at(i), &b = at(next(i));
      if (!(a.y > m.y && b.y <= m.y) || orientation(a, b, m) < 0) return;
      if (best == kNone || liesRightOf(i, best)) best = i;
    });
    return best;
  }

  /// Whether edge e lies to the right of f; both go down and cross a common horizontal line, but not each other.
  bool liesRightOf(uint32_t e, uint32_t f) const {
    return (turn(f, next(f), e) >= 0 && turn(f, next(f), next(e)) >= 0) || (turn(e, next(e), f) <= 0 && turn(e, next(e), next(f)) <= 0);
  }

  uint32_t nearestTo(const Point& m) const {
    uint32_t best = loopFirst_[0];
    forChain(best, [&](uint32_t i) {
      if (squaredDistance(at(i), m) < squaredDistance(at(best), m)) best = i;
    });
    return best;
  }

  // ---- Clipping ears

  void emit(uint32_t a, uint32_t b, uint32_t c) {
    triangles_->insert(triangles_->end(), {corners_[a].vertex, corners_[b].vertex, corners_[c].vertex});
  }

  /// The fast path of small chains: all triangles at one corner, if all have positive area.
  bool clipFan() {
    constexpr size_t kMost = 8;
    if (corners_.size() > kMost) return false;
    for (uint32_t apex = 0; apex < corners_.size(); ++apex) {
      bool positive = true;
      for (uint32_t i = next(apex); positive && next(i) != apex; i = next(i)) positive = turn(apex, i, next(i)) > 0;
      if (!positive) continue;
      for (uint32_t i = next(apex); next(i) != apex; i = next(i)) emit(apex, i, next(i));
      return true;
    }
    return false;
  }

  void clipEars() {
    remaining_ = corners_.size();
    tree_.build(corners_);
    heap_.clear();
    watchers_.clear();
    for (uint32_t i = 0; i < corners_.size(); ++i) suggest(i);
    uint32_t some = 0;
    while (remaining_ > 3) {
      const uint32_t ear = nextEar();
      some = clip(ear != kNone ? ear : leastBadEar(some));
    }
    if (remaining_ == 3) emit(previous(some), some, next(some));
  }

  void suggest(uint32_t ear) {
    const uint32_t version = ++corners_[ear].version;
    if (!(turn(previous(ear), ear, next(ear)) > 0)) return;
    heap_.push_back({squaredDistance(at(previous(ear)), at(next(ear))), ear, version});
    std::push_heap(heap_.begin(), heap_.end());
  }

  uint32_t nextEar() {
    while (!heap_.empty()) {
      const HeapEntry top = heap_.front();
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      if (!corners_[top.corner].alive || corners_[top.corner].version != top.version) continue;
      const uint32_t blocker = blockerOf(top.corner, true);
      if (blocker == kNone) return top.corner;
      watchers_.push_back({top.corner, top.version, corners_[blocker].firstWatcher});
      corners_[blocker].firstWatcher = uint32_t(watchers_.size()) - 1;
    }
    return kNone;
  }

  /// A corner because of which a convex corner is no ear, as long as it is there; kNone if it is one. Corners at the same places as the
  /// ear's do not block: where a vertex has several, the wedges of the face at them are disjoint, and if an edge there led into the ear,
  /// its other end or what is beyond would lie inside too. On the ear's border corners block if it is `closed`.
  uint32_t blockerOf(uint32_t ear, bool closed) const {
    const Point &p = at(previous(ear)), &q = at(ear), &r = at(next(ear));
    const Point low = {std::min({p.x, q.x, r.x}), std::min({p.y, q.y, r.y})}, high = {std::max({p.x, q.x, r.x}), std::max({p.y, q.y, r.y})};
    return tree_.find(corners_, low, high, [&](uint32_t i) {
      const Point& x = at(i);
      if (x == p || x == q || x == r) return false;
      const auto within = [closed](double side) { return closed ? side >= 0 : side > 0; };
      return within(orientation(p, q, x)) && within(orientation(q, r, x)) && within(orientation(r, p, x));
    });
  }

  /// Where there is no ear: a slit that ends here, else what touches others only in its border, else the smallest area, but triangles flat
  /// along a side last.
  uint32_t leastBadEar(uint32_t first) const {
    uint32_t best = first;
    std::pair<int, double> least = {4, 0};
    forChain(first, [&](uint32_t i) {
      const uint32_t a = previous(i), c = next(i);
      const double area = turn(a, i, c);
      std::pair<int, double> badness = {2, std::fabs(area)};
      if (corners_[a].vertex == corners_[c].vertex) {
        badness.first = 0;
      } else if (area > 0 && blockerOf(i, false) == kNone) {
        badness.first = 1;
      } else if (area == 0 && (at(a).x - at(i).x) * (at(c).x - at(i).x) + (at(a).y - at(i).y) * (at(c).y - at(i).y) < 0) {
        badness.first = 3;
      }
      if (badness < least) {
        least = badness;
        best = i;
      }
    });
    return best;
  }

  /// Clips an ear off; returns a corner that stays.
  uint32_t clip(uint32_t ear) {
    const uint32_t a = previous(ear), c = next(ear);
    remove(ear);
    if (corners_[a].vertex != corners_[c].vertex) {
      emit(a, ear, c);
      link(a, c);
    } else {  // there and back: the two edges are each other's other side
      remove(c);
      link(a, next(c));
    }
    suggest(a);
    suggest(next(a));
    wakeWatchers(ear);
    if (!corners_[c].alive) wakeWatchers(c);
    return a;
  }

  void remove(uint32_t corner) {
    corners_[corner].alive = false;
    tree_.remove(corner);
    --remaining_;
  }

  void wakeWatchers(uint32_t corner) {
    for (uint32_t w = corners_[corner].firstWatcher; w != kNone; w = watchers_[w].next) {
      const Watcher watcher = watchers_[w];
      if (corners_[watcher.corner].alive && corners_[watcher.corner].version == watcher.version) suggest(watcher.corner);
    }
  }

  std::vector<Corner> corners_;
  std::vector<uint32_t> loopFirst_;  // per loop
  std::vector<uint32_t> chain_;      // per loop: a lower loop of its chain, or itself
  std::vector<uint32_t> shared_, holes_;
  CornerTree tree_;
  std::vector<HeapEntry> heap_;
  std::vector<Watcher> watchers_;
  size_t remaining_ = 0;
  std::vector<uint32_t>* triangles_ = nullptr;
};

PolygonTriangulator::PolygonTriangulator() : implementation_(std::make_unique<Implementation>()) {}
PolygonTriangulator::~PolygonTriangulator() = default;
void PolygonTriangulator::startLoop() { implementation_->startLoop(); }
void PolygonTriangulator::addCorner(uint32_t vertex, const PlanePoint& at) { implementation_->addCorner(vertex, at); }
void PolygonTriangulator::run(std::vector<uint32_t>& triangles) { implementation_->run(triangles); }

}  // namespace mandoline::operators
