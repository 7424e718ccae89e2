#include "operators/triangulate/loop_joiner.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::operators {

void LoopJoiner::run(Chains& chains) {
  chains_ = &chains;
  chain_.resize(chains.loopFirst.size());
  for (uint32_t l = 0; l < chain_.size(); ++l) chain_[l] = l;
  spliceSharedVertices();
  bridgeHoles();
}

uint32_t LoopJoiner::chainOf(uint32_t loop) {
  while (chain_[loop] != loop) loop = chain_[loop] = chain_[chain_[loop]];
  return loop;
}

uint32_t LoopJoiner::loopOf(uint32_t corner) const {
  const std::vector<uint32_t>& firsts = chains_->loopFirst;
  return uint32_t(std::upper_bound(firsts.begin(), firsts.end(), corner) - firsts.begin()) - 1;
}

void LoopJoiner::spliceSharedVertices() {
  const auto vertex = [&](uint32_t i) { return chains_->vertex(i); };
  shared_.clear();
  for (uint32_t i = 0; i < chains_->corners.size(); ++i) shared_.push_back(i);
  detail::sortItems(shared_, [&](uint32_t a, uint32_t b) { return std::pair(vertex(a), a) < std::pair(vertex(b), b); });
  for (size_t begin = 0, end; begin < shared_.size(); begin = end) {
    end = begin + 1;
    while (end < shared_.size() && vertex(shared_[end]) == vertex(shared_[begin])) ++end;
    if (end - begin > 1) {
      splice(begin, end, true);
      splice(begin, end, false);
    }
  }
}

/// Splices the chains that meet in a vertex, at corners that open towards each other if wanted.
void LoopJoiner::splice(size_t begin, size_t end, bool open) {
  for (size_t i = begin; i < end; ++i) {
    for (size_t j = begin; j < end; ++j) {
      const uint32_t a = shared_[i], b = shared_[j], chainA = chainOf(loopOf(a)), chainB = chainOf(loopOf(b));
      if (chainA == chainB || (open && !chains_->opensTowards(a, chains_->at(chains_->next(b))))) continue;
      const uint32_t afterA = chains_->next(a);
      chains_->link(a, chains_->next(b));
      chains_->link(b, afterA);
      chain_[std::max(chainA, chainB)] = std::min(chainA, chainB);
    }
  }
}

/// Holes from left to right, so that everything to the left of each is already in one chain with the outer loop.
void LoopJoiner::bridgeHoles() {
  const auto place = [&](uint32_t i) { return std::pair(chains_->at(i).x, chains_->at(i).y); };
  holes_.clear();
  for (uint32_t l = 1; l < chains_->loopFirst.size(); ++l) {
    if (chainOf(l) != l) continue;
    uint32_t leftmost = chains_->loopFirst[l];
    chains_->forChain(chains_->loopFirst[l], [&](uint32_t i) {
      if (place(i) < place(leftmost)) leftmost = i;
    });
    holes_.push_back(leftmost);
  }
  detail::sortItems(holes_, [&](uint32_t a, uint32_t b) { return std::pair(place(a), a) < std::pair(place(b), b); });
  for (const uint32_t hole : holes_) {
    const uint32_t end = visibleFrom(hole);
    const PlanePoint towards = chains_->at(end);
    uint32_t start = hole;
    chains_->forChain(hole, [&](uint32_t i) {
      if (chains_->at(i) == chains_->at(hole) && !chains_->opensTowards(start, towards) && chains_->opensTowards(i, towards)) start = i;
    });
    bridge(end, start);
  }
}

/// Joins two chains by an edge from corner to corner, there and back.
void LoopJoiner::bridge(uint32_t a, uint32_t b) {
  std::vector<Corner>& corners = chains_->corners;
  const uint32_t a2 = uint32_t(corners.size()), b2 = a2 + 1, afterA = chains_->next(a), beforeB = chains_->previous(b);
  for (const uint32_t i : {a, b}) {
    const Corner copy = {corners[i].at, corners[i].vertex, kNone, kNone};
    corners.push_back(copy);
  }
  chains_->link(a, b);
  chains_->link(beforeB, b2);
  chains_->link(b2, a2);
  chains_->link(a2, afterA);
}

/// A corner of the outer loop's chain that is visible from the leftmost corner of a hole (Eberly, "Triangulation by Ear Clipping"): the
/// ray to the left meets an edge; turned towards that edge's left end, it meets a corner, no later than the end.
uint32_t LoopJoiner::visibleFrom(uint32_t hole) const {
  const Chains& chains = *chains_;
  const PlanePoint m = chains.at(hole);
  const uint32_t edge = edgeLeftOf(m);
  if (edge == kNone) return nearestTo(m);
  const bool upwards = chains.at(edge).x < chains.at(chains.next(edge)).x;
  const double sense = upwards ? 1 : -1;
  uint32_t best = upwards ? edge : chains.next(edge);
  const auto isBetterAtTheSamePlace = [&](uint32_t i) { return !chains.opensTowards(best, m) && chains.opensTowards(i, m); };
  chains.forChain(chains.loopFirst[0], [&](uint32_t i) {
    const PlanePoint& p = chains.at(i);
    if (!(p.x < m.x) || sense * (p.y - m.y) < 0 || orientation(chains.at(edge), chains.at(chains.next(edge)), p) < 0) return;
    const double nearer = sense * orientation(m, chains.at(best), p);
    const auto beyond = [&] { return p.x > chains.at(best).x || (p == chains.at(best) && isBetterAtTheSamePlace(i)); };
    if (nearer > 0 || (nearer == 0 && beyond())) best = i;
  });
  return best;
}

/// The edge of the outer loop's chain that a ray to the left meets first, by its start, the upper end; kNone if rounding has left none.
uint32_t LoopJoiner::edgeLeftOf(const PlanePoint& m) const {
  uint32_t best = kNone;
  chains_->forChain(chains_->loopFirst[0], [&](uint32_t i) {
    const PlanePoint &a = chains_->at(i), &b = chains_->at(chains_->next(i));
    if (!(a.y > m.y && b.y <= m.y) || orientation(a, b, m) < 0) return;
    if (best == kNone || liesRightOf(i, best)) best = i;
  });
  return best;
}

/// Whether edge e lies to the right of f; both go down and cross a common horizontal line, but not each other.
bool LoopJoiner::liesRightOf(uint32_t e, uint32_t f) const {
  const uint32_t e2 = chains_->next(e), f2 = chains_->next(f);
  return (chains_->turn(f, f2, e) >= 0 && chains_->turn(f, f2, e2) >= 0) || (chains_->turn(e, e2, f) <= 0 && chains_->turn(e, e2, f2) <= 0);
}

uint32_t LoopJoiner::nearestTo(const PlanePoint& m) const {
  uint32_t best = chains_->loopFirst[0];
  chains_->forChain(best, [&](uint32_t i) {
    if (squaredDistance(chains_->at(i), m) < squaredDistance(chains_->at(best), m)) best = i;
  });
  return best;
}

}  // namespace mandoline::operators
