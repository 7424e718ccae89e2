#include "operators/triangulate/ear_clipper.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

namespace mandoline::operators {
namespace {

constexpr double kNoEar = std::numeric_limits<double>::infinity();

constexpr uint64_t bit(uint32_t corner) { return uint64_t{1} << corner; }

}  // namespace

bool EarClipper::HeapEntry::operator<(const HeapEntry& other) const {
  return std::tie(key, corner, version) > std::tie(other.key, other.corner, other.version);
}

void EarClipper::run(Chains& chains, std::vector<uint32_t>& triangles) {
  chains_ = &chains;
  const size_t before = triangles.size();
  triangles.resize(before + 3 * (chains.corners.size() - 2));
  triangle_ = triangles.data() + before;
  if (!clipFan()) clipEars();
  triangles.resize(size_t(triangle_ - triangles.data()));
}

void EarClipper::emit(uint32_t a, uint32_t b, uint32_t c) {
  triangle_[0] = chains_->vertex(a);
  triangle_[1] = chains_->vertex(b);
  triangle_[2] = chains_->vertex(c);
  triangle_ += 3;
}

/// The fast path of small chains: all triangles at one corner, if all have positive area.
bool EarClipper::clipFan() {
  const Chains& chains = *chains_;
  if (!isSmall()) return false;
  for (uint32_t apex = 0; apex < chains.corners.size(); ++apex) {
    bool positive = true;
    for (uint32_t i = chains.next(apex); positive && chains.next(i) != apex; i = chains.next(i))
      positive = chains.turn(apex, i, chains.next(i)) > 0;
    if (!positive) continue;
    for (uint32_t i = chains.next(apex); chains.next(i) != apex; i = chains.next(i)) emit(apex, i, chains.next(i));
    return true;
  }
  return false;
}

void EarClipper::clipEars() {
  remaining_ = chains_->corners.size();
  if (isSmall()) {
    keys_.assign(remaining_, kNoEar);
    reflex_ = 0;
  } else {
    tree_.build(chains_->corners);
    heap_.clear();
  }
  watchers_.clear();
  for (uint32_t i = 0; i < chains_->corners.size(); ++i) suggest(i);
  uint32_t some = 0;
  while (remaining_ > 3) {
    const uint32_t ear = nextEar();
    some = clip(ear != kNone ? ear : leastBadEar(some));
  }
  if (remaining_ == 3) emit(chains_->previous(some), some, chains_->next(some));
}

void EarClipper::suggest(uint32_t ear) {
  const uint32_t version = ++chains_->corners[ear].version, before = chains_->previous(ear), after = chains_->next(ear);
  const bool isConvex = chains_->turn(before, ear, after) > 0;
  if (!isConvex && !isSmall()) return;
  const double key = isConvex ? squaredDistance(chains_->at(before), chains_->at(after)) : kNoEar;
  if (isSmall()) {
    keys_[ear] = key;
    reflex_ = (reflex_ & ~bit(ear)) | (isConvex ? 0 : bit(ear));
  } else {
    heap_.push_back({key, ear, version});
    std::push_heap(heap_.begin(), heap_.end());
  }
}

/// Takes the suggested corner with the lowest key, and of equal keys the lowest corner; kNone when none is left.
uint32_t EarClipper::takeSuggested() {
  if (isSmall()) {  // a heap would cost more than looking at all of them
    const auto least = std::min_element(keys_.begin(), keys_.end());
    if (*least == kNoEar) return kNone;
    *least = kNoEar;
    return uint32_t(least - keys_.begin());
  }
  while (!heap_.empty()) {
    const HeapEntry top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    const Corner& corner = chains_->corners[top.corner];
    if (corner.alive && corner.version == top.version) return top.corner;
  }
  return kNone;
}

uint32_t EarClipper::nextEar() {
  for (;;) {
    const uint32_t ear = takeSuggested();
    const uint32_t blocker = ear == kNone ? kNone : blockerOf(ear, true);
    if (blocker == kNone) return ear;
    uint32_t& first = chains_->corners[blocker].firstWatcher;
    watchers_.push_back({ear, chains_->corners[ear].version, first});
    first = uint32_t(watchers_.size()) - 1;
  }
}

/// A corner that keeps a convex corner from being an ear as long as it is there; kNone if the corner is an ear. Corners at the same places
/// as the ear's do not block: where a vertex has several, the wedges of the face at them are disjoint, and if an edge there led into the
/// ear, its other end or what is beyond would lie inside too. On the ear's border corners block if it is `closed`. Only corners that are
/// not convex need to be asked: of all that block, the one farthest from the edge that the ear leaves is such a corner.
uint32_t EarClipper::blockerOf(uint32_t ear, bool closed) const {
  const PlanePoint &p = chains_->at(chains_->previous(ear)), &q = chains_->at(ear), &r = chains_->at(chains_->next(ear));
  const PlanePoint low = {std::min({p.x, q.x, r.x}), std::min({p.y, q.y, r.y})};
  const PlanePoint high = {std::max({p.x, q.x, r.x}), std::max({p.y, q.y, r.y})};
  const auto blocks = [&](uint32_t i) {
    const PlanePoint& x = chains_->at(i);
    if (x == p || x == q || x == r) return false;
    const auto within = [closed](double side) { return closed ? side >= 0 : side > 0; };
    return within(orientation(p, q, x)) && within(orientation(q, r, x)) && within(orientation(r, p, x));
  };
  if (!isSmall()) return tree_.find(chains_->corners, low, high, blocks);
  for (uint64_t left = reflex_; left != 0; left &= left - 1) {
    const auto i = uint32_t(std::countr_zero(left));
    const PlanePoint& x = chains_->at(i);
    if (low.x <= x.x && x.x <= high.x && low.y <= x.y && x.y <= high.y && blocks(i)) return i;
  }
  return kNone;
}

uint32_t EarClipper::leastBadEar(uint32_t first) const {
  uint32_t best = first;
  std::pair<int, double> least = {4, 0};
  chains_->forChain(first, [&](uint32_t i) {
    const std::pair<int, double> bad = badness(i);
    if (bad < least) {
      least = bad;
      best = i;
    }
  });
  return best;
}

/// The rank of a corner where there is no ear: slits that end here first, then triangles that touch others only in their border, then the
/// smallest area; triangles flat along a side last.
std::pair<int, double> EarClipper::badness(uint32_t ear) const {
  const uint32_t before = chains_->previous(ear), after = chains_->next(ear);
  const PlanePoint &a = chains_->at(before), &b = chains_->at(ear), &c = chains_->at(after);
  const double area = orientation(a, b, c);
  const auto rank = [&] {
    if (chains_->vertex(before) == chains_->vertex(after)) return 0;
    if (area > 0 && blockerOf(ear, false) == kNone) return 1;
    return area == 0 && (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y) < 0 ? 3 : 2;
  };
  return {rank(), std::fabs(area)};
}

/// Clips an ear off; returns a corner that stays.
uint32_t EarClipper::clip(uint32_t ear) {
  const uint32_t a = chains_->previous(ear), c = chains_->next(ear);
  remove(ear);
  if (chains_->vertex(a) != chains_->vertex(c)) {
    emit(a, ear, c);
    chains_->link(a, c);
  } else {  // there and back: the two edges are each other's other side
    remove(c);
    chains_->link(a, chains_->next(c));
  }
  suggest(a);
  suggest(chains_->next(a));
  wakeWatchers(ear);
  if (!chains_->corners[c].alive) wakeWatchers(c);
  return a;
}

void EarClipper::remove(uint32_t corner) {
  chains_->corners[corner].alive = false;
  if (isSmall()) {
    keys_[corner] = kNoEar;
    reflex_ &= ~bit(corner);
  } else {
    tree_.remove(corner);
  }
  --remaining_;
}

void EarClipper::wakeWatchers(uint32_t corner) {
  for (uint32_t w = chains_->corners[corner].firstWatcher; w != kNone; w = watchers_[w].next) {
    const Watcher watcher = watchers_[w];
    if (chains_->corners[watcher.corner].alive && chains_->corners[watcher.corner].version == watcher.version) suggest(watcher.corner);
  }
}

}  // namespace mandoline::operators
