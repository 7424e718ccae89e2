#include "cut/stages/planar_graph.h"

#include <algorithm>

namespace mandoline::detail {

void PlanarGraph::begin(const CutVertices& vertices, int axis) {
  vertices_ = &vertices;
  axis_ = axis;
  ids_.clear();
  ends_.clear();
  if (localTable_.size() < vertices.size()) localTable_.resize(vertices.size());
}

uint32_t PlanarGraph::localOf(uint32_t id) {
  uint32_t& local = localTable_[id];
  if (local >= ids_.size() || ids_[local] != id) {
    local = uint32_t(ids_.size());
    ids_.push_back(id);
  }
  return local;
}

void PlanarGraph::setOutline(const std::vector<uint32_t>& vertexIds) {
  sides_ = vertexIds.size();
  for (const uint32_t id : vertexIds) localOf(id);
  for (uint32_t i = 0; i < sides_; ++i) {
    ends_.push_back(i);
    ends_.push_back(i + 1 < sides_ ? i + 1 : 0);
  }
}

void PlanarGraph::addEdge(uint32_t from, uint32_t to) {
  ends_.push_back(localOf(from));
  ends_.push_back(localOf(to));
}

void PlanarGraph::build(Predicates& predicates) {
  const size_t n = ids_.size(), halfEdges = ends_.size();
  outOffsets_.assign(n + 1, 0);
  for (const uint32_t v : ends_) ++outOffsets_[v + 1];
  for (size_t v = 0; v < n; ++v) outOffsets_[v + 1] += outOffsets_[v];
  out_.resize(halfEdges);
  at_.assign(outOffsets_.begin(), outOffsets_.end() - 1);
  for (uint32_t h = 0; h < halfEdges; ++h) out_[at_[ends_[h]]++] = h;
  nextOf_.resize(halfEdges);
  for (uint32_t v = 0; v < n; ++v) orderOutgoing(v, predicates);
  traceCycles();
  placeComponents(predicates);
  traceLoops(predicates);
}

void PlanarGraph::orderOutgoing(uint32_t v, Predicates& predicates) {
  uint32_t *begin = out_.data() + outOffsets_[v], *end = out_.data() + outOffsets_[v + 1];
  if (v < sides_) {  // along the outline first, edges inside counter-clockwise, back along the outline last
    const uint32_t forward = 2 * v, backward = 2 * uint32_t(v > 0 ? v - 1 : sides_ - 1) + 1;
    std::iter_swap(begin, std::find(begin, end, forward));
    std::iter_swap(end - 1, std::find(begin, end, backward));
    sortAround(v, begin + 1, end - 1, false, predicates);
  } else if (end - begin > 2) {
    sortAround(v, begin, end, true, predicates);
  }
  // Coming in along the twin of an outgoing half-edge, a face on the left goes on along the one clockwise of it.
  for (const uint32_t* h = begin; h < end; ++h) nextOf_[*h ^ 1] = h > begin ? h[-1] : end[-1];
}

/// P4: sorts half-edges out of v by angle; those of a side's vertex span less than half a turn.
void PlanarGraph::sortAround(uint32_t v, uint32_t* begin, uint32_t* end, bool fullCircle, Predicates& predicates) {
  if (end - begin < 2) return;
  const auto head = [&](uint32_t h) { return ids_[ends_[h ^ 1]]; };
  const auto turn = [&](uint32_t g, uint32_t h) { return vertices_->orient(ids_[v], head(g), head(h), axis_, predicates); };
  std::vector<std::pair<int, uint32_t>> byQuarter;  // 0: like the first one, 1: left of it, 2: opposite, 3: right of it
  for (const uint32_t* h = begin; h < end; ++h) {
    int quarter = 0;
    if (fullCircle && h > begin) {
      const int side = turn(*begin, *h);
      quarter = side > 0                                                                                 ? 1
                : side < 0                                                                               ? 3
                : isBefore(head(*begin), ids_[v], predicates) != isBefore(head(*h), ids_[v], predicates) ? 2
                                                                                                         : 0;
    }
    byQuarter.push_back({quarter, *h});
  }
  std::sort(byQuarter.begin(), byQuarter.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second != b.second && turn(a.second, b.second) > 0;
  });
  for (size_t i = 0; i < byQuarter.size(); ++i) {
    begin[i] = byQuarter[i].second;
    if (i > 0 && byQuarter[i].first == byQuarter[i - 1].first && turn(begin[i - 1], begin[i]) == 0) {
      vertices_->failSelfIntersectionAt(head(begin[i - 1]), head(begin[i]));
    }
  }
}

void PlanarGraph::traceCycles() {
  constexpr uint32_t kNone = ~0u;
  cycleOf_.assign(ends_.size(), kNone);
  cycleStarts_.clear();
  for (uint32_t start = 0; start < ends_.size(); ++start) {
    if (cycleOf_[start] != kNone) continue;
    for (uint32_t h = start; cycleOf_[h] == kNone; h = nextOf_[h]) cycleOf_[h] = uint32_t(cycleStarts_.size());
    cycleStarts_.push_back(start);
  }
}

/// Lexicographic order in the plane.
bool PlanarGraph::isBefore(uint32_t u, uint32_t v, Predicates& predicates) const {
  const int first = vertices_->compare(u, v, (axis_ + 1) % 3, predicates);
  return first != 0 ? first < 0 : vertices_->compare(u, v, (axis_ + 2) % 3, predicates) < 0;
}

/// The cycle that runs around a component from outside: it passes the component's first vertex where the rest lies to the right.
uint32_t PlanarGraph::exteriorCycle(const std::vector<uint32_t>& component, Predicates& predicates) {
  uint32_t first = component[0];
  for (const uint32_t v : component) {
    if (isBefore(ids_[v], ids_[first], predicates)) first = v;
  }
  uint32_t last = out_[outOffsets_[first]];  // the half-edge farthest counter-clockwise
  for (uint32_t i = outOffsets_[first] + 1; i < outOffsets_[first + 1]; ++i) {
    const int turn = vertices_->orient(ids_[first], ids_[ends_[last ^ 1]], ids_[ends_[out_[i] ^ 1]], axis_, predicates);
    if (turn == 0) vertices_->failSelfIntersectionAt(ids_[ends_[last ^ 1]], ids_[ends_[out_[i] ^ 1]]);
    if (turn > 0) last = out_[i];
  }
  return cycleOf_[last];
}

/// P5: gives every cycle its face. Cycles of the outline's component are faces of their own; a component that floats inside the
/// square has one cycle around it, which belongs to the face that holds the component.
void PlanarGraph::placeComponents(Predicates& predicates) {
  faceOf_.assign(cycleStarts_.size(), kUnset);
  faceOf_[cycleOf_[1]] = kOutside;
  faceCount = 0;
  findFloating(predicates);
  for (uint32_t cycle = 0; cycle < faceOf_.size(); ++cycle) {
    if (faceOf_[cycle] == kUnset && !isExterior_[cycle]) faceOf_[cycle] = faceCount++;
  }
  if (floating_.empty()) return;
  findHolders(predicates);
  // The innermost holder is the one whose component is itself held most often; the outline's is held by none.
  const auto depthOf = [&](uint32_t cycle) {
    const uint32_t component = componentOf_[ends_[cycleStarts_[cycle]]];
    return component < floating_.size() ? floating_[component].holders.size() : 0;
  };
  for (const Floating& component : floating_) {
    uint32_t innermost = kUnset;
    for (const uint32_t c : component.holders) {
      if (innermost == kUnset || depthOf(c) > depthOf(innermost)) innermost = c;
    }
    if (innermost == kUnset || depthOf(innermost) + 1 != component.holders.size()) {  // loops that cross
      const uint32_t other = component.holders.empty() ? 0 : ends_[cycleStarts_[component.holders.back()]];
      vertices_->failSelfIntersectionAt(ids_[component.members[0]], ids_[other]);
    }
    faceOf_[component.exterior] = faceOf_[innermost];
  }
}

/// The components that do not reach the outline.
void PlanarGraph::findFloating(Predicates& predicates) {
  floating_.clear();
  isExterior_.assign(cycleStarts_.size(), 0);
  components_.reset(ids_.size());
  for (size_t h = 0; h < ends_.size(); h += 2) components_.unite(ends_[h], ends_[h + 1]);
  std::vector<uint32_t> roots;
  for (uint32_t v = uint32_t(sides_); v < ids_.size(); ++v) {
    if (components_.find(v) == v) roots.push_back(v);
  }
  if (roots.empty()) return;
  floating_.resize(roots.size());
  componentOf_.assign(ids_.size(), uint32_t(roots.size()));  // the outline's, unless found to float
  for (uint32_t v = uint32_t(sides_); v < ids_.size(); ++v) {
    const auto root = std::lower_bound(roots.begin(), roots.end(), components_.find(v));
    if (root == roots.end() || *root != components_.find(v)) continue;
    componentOf_[v] = uint32_t(root - roots.begin());
    floating_[componentOf_[v]].members.push_back(v);
  }
  for (Floating& component : floating_) {
    component.exterior = exteriorCycle(component.members, predicates);
    isExterior_[component.exterior] = 1;
  }
}

/// Which bounded cycles hold each component: those that a ray to growing p from one of its vertices leaves an odd number of times.
void PlanarGraph::findHolders(Predicates& predicates) {
  const int p = (axis_ + 1) % 3, q = (axis_ + 2) % 3;
  std::vector<CutVertices::Range> rangeP(ids_.size()), rangeQ(ids_.size());
  for (uint32_t v = 0; v < ids_.size(); ++v) {
    rangeP[v] = vertices_->range(ids_[v], p, predicates);
    rangeQ[v] = vertices_->range(ids_[v], q, predicates);
  }
  std::vector<uint8_t> odd(cycleStarts_.size(), 0);
  for (uint32_t k = 0; k < floating_.size(); ++k) {
    const uint32_t v = floating_[k].members[0];
    std::fill(odd.begin(), odd.end(), uint8_t(0));
    const auto above = [&](uint32_t u) {
      return rangeQ[u].low > rangeQ[v].high || (rangeQ[u].high >= rangeQ[v].low && vertices_->compare(ids_[u], ids_[v], q, predicates) > 0);
    };
    for (uint32_t h = 0; h < ends_.size(); h += 2) {
      uint32_t low = ends_[h], high = ends_[h + 1];
      if (componentOf_[low] == k || std::max(rangeP[low].high, rangeP[high].high) < rangeP[v].low) continue;
      if (above(low) == above(high)) continue;
      if (above(low)) std::swap(low, high);
      const int side = vertices_->orient(ids_[low], ids_[high], ids_[v], axis_, predicates);
      if (side == 0) vertices_->failSelfIntersectionAt(ids_[v], ids_[low]);
      if (side < 0) continue;
      odd[cycleOf_[h]] ^= 1;
      odd[cycleOf_[h ^ 1]] ^= 1;
    }
    for (uint32_t c = 0; c < odd.size(); ++c) {
      if (odd[c] && faceOf_[c] != kOutside && !isExterior_[c]) floating_[k].holders.push_back(c);
    }
  }
}

/// Traces the cycles again without slits, and puts the outer loop of each face first.
void PlanarGraph::traceLoops(Predicates& predicates) {
  loopStarts.clear();
  loopFaces.clear();
  traced_.assign(ends_.size(), 0);
  for (uint32_t start = 0; start < ends_.size(); ++start) {
    if (traced_[start] || isSlit(start) || face(start) == kOutside) continue;
    for (uint32_t h = start; !traced_[h]; h = next(h)) traced_[h] = 1;
    loopStarts.push_back(start);
    loopFaces.push_back(face(start));
  }
  bool inOrder = true;  // one loop for each face, as nearly always
  for (size_t l = 0; l < loopFaces.size(); ++l) inOrder &= loopFaces[l] == l;
  if (inOrder) return;
  std::vector<uint32_t> order(loopStarts.size());
  for (uint32_t l = 0; l < order.size(); ++l) order[l] = l;
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return loopFaces[a] < loopFaces[b]; });
  for (size_t i = 0, end; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && loopFaces[order[end]] == loopFaces[order[i]];) ++end;
    if (end - i == 1) continue;
    size_t outer = i;  // the outer loop has the first vertex of all
    uint32_t first = origin(loopStarts[order[i]]);
    for (size_t l = i; l < end; ++l) {
      uint32_t h = loopStarts[order[l]];
      do {
        if (origin(h) != first && isBefore(ids_[origin(h)], ids_[first], predicates)) {
          first = origin(h);
          outer = l;
        }
        h = next(h);
      } while (h != loopStarts[order[l]]);
    }
    std::rotate(order.begin() + i, order.begin() + outer, order.begin() + outer + 1);
  }
  std::vector<uint32_t> starts, faces;
  for (const uint32_t l : order) {
    starts.push_back(loopStarts[l]);
    faces.push_back(loopFaces[l]);
  }
  loopStarts.swap(starts);
  loopFaces.swap(faces);
}

uint32_t PlanarGraph::find(uint32_t fromId, uint32_t toId) const {
  const auto known = [&](uint32_t id) { return localTable_[id] < ids_.size() && ids_[localTable_[id]] == id; };
  if (!known(fromId) || !known(toId)) return kOutside;
  const uint32_t v = localTable_[fromId];
  for (uint32_t i = outOffsets_[v]; i < outOffsets_[v + 1]; ++i) {
    if (ids_[ends_[out_[i] ^ 1]] == toId) return out_[i];
  }
  return kOutside;
}

}  // namespace mandoline::detail
