#include "cut/stages/planar_graph.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::detail {

void PlanarGraph::begin(const CutVertices& vertices, int axis) {
  vertices_ = &vertices;
  axis_ = axis;
  ids_.clear();
  ends_.clear();
  if (localTable_.size() < vertices.size()) localTable_.resize(vertices.size() + vertices.slabs.size() / 4);
}

GraphVertex PlanarGraph::localOf(VertexId id) {
  GraphVertex& local = localTable_[id];
  if (local.number >= ids_.size() || ids_[local] != id) {
    local = {uint32_t(ids_.size())};
    ids_.push_back(id);
  }
  return local;
}

void PlanarGraph::setOutline(std::span<const VertexId> outline) {
  sides_ = outline.size();
  for (const VertexId id : outline) localOf(id);
  for (uint32_t i = 0; i < sides_; ++i) {
    ends_.push_back({i});
    ends_.push_back({i + 1 < sides_ ? i + 1 : 0});
  }
}

void PlanarGraph::addEdge(VertexId from, VertexId to) {
  ends_.push_back(localOf(from));
  ends_.push_back(localOf(to));
}

void PlanarGraph::build(Predicates& predicates, Slits slits) {
  slits_ = slits;
  const size_t n = ids_.size();
  std::vector<uint32_t>& offsets = out_.offsets;
  offsets.assign(n + 1, 0);
  for (const GraphVertex v : ends_) ++offsets[v.number + 1];
  for (size_t v = 0; v < n; ++v) offsets[v + 1] += offsets[v];
  out_.items.resize(ends_.size());
  at_.assign(offsets.begin(), offsets.end() - 1);
  for (const HalfEdge h : ends_.ids()) out_.items[at_[ends_[h].number]++] = h;
  nextOf_.resize(ends_.size());
  for (const GraphVertex v : ids_.ids()) orderOutgoing(v, predicates);
  traceCycles();
  placeComponents(predicates);
  traceLoops(predicates);
}

void PlanarGraph::orderOutgoing(GraphVertex v, Predicates& predicates) {
  const std::span<HalfEdge> out = out_[v];
  if (v.number < sides_) {  // along the outline first, edges inside counter-clockwise, back along the outline last
    const uint32_t before = v.number > 0 ? v.number - 1 : uint32_t(sides_ - 1);
    const HalfEdge forward{2 * v.number}, backward{2 * before + 1};
    std::iter_swap(out.begin(), std::find(out.begin(), out.end(), forward));
    std::iter_swap(out.end() - 1, std::find(out.begin(), out.end(), backward));
    sortAround(v, out.subspan(1, out.size() - 2), false, predicates);
  } else if (out.size() > 2) {
    sortAround(v, out, true, predicates);
  }
  // Coming in along the twin of an outgoing half-edge, a face on the left goes on along the one clockwise of it.
  for (size_t i = 0; i < out.size(); ++i) nextOf_[out[i].twin()] = out[i > 0 ? i - 1 : out.size() - 1];
}

/// P4: sorts half-edges out of v by angle; those of a side's vertex span less than half a turn.
void PlanarGraph::sortAround(GraphVertex v, std::span<HalfEdge> out, bool fullCircle, Predicates& predicates) {
  if (out.size() < 2) return;
  const auto head = [&](HalfEdge h) { return origin(h.twin()); };
  const auto turn = [&](HalfEdge g, HalfEdge h) { return vertices_->orient(ids_[v], head(g), head(h), axis_, predicates); };
  const auto isBehind = [&](HalfEdge h) { return isBefore(head(h), ids_[v], predicates); };
  std::vector<std::pair<int, HalfEdge>> byQuarter;  // 0: like the first one, 1: left of it, 2: opposite, 3: right of it
  for (size_t i = 0; i < out.size(); ++i) {
    int quarter = 0;
    if (fullCircle && i > 0) {
      const int side = turn(out[0], out[i]);
      quarter = side > 0 ? 1 : side < 0 ? 3 : isBehind(out[0]) != isBehind(out[i]) ? 2 : 0;
    }
    byQuarter.push_back({quarter, out[i]});
  }
  sortItems(byQuarter, [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second != b.second && turn(a.second, b.second) > 0;
  });
  for (size_t i = 0; i < byQuarter.size(); ++i) {
    out[i] = byQuarter[i].second;
    if (i > 0 && byQuarter[i].first == byQuarter[i - 1].first && turn(out[i - 1], out[i]) == 0) {
      vertices_->failSelfIntersectionAt(head(out[i - 1]), head(out[i]));
    }
  }
}

void PlanarGraph::traceCycles() {
  cycleOf_.assign(ends_.size(), kNoCycle);
  cycleStarts_.clear();
  for (const HalfEdge start : ends_.ids()) {
    if (cycleOf_[start] != kNoCycle) continue;
    const Cycle cycle{uint32_t(cycleStarts_.size())};
    for (HalfEdge h = start; cycleOf_[h] == kNoCycle; h = nextOf_[h]) cycleOf_[h] = cycle;
    cycleStarts_.push_back(start);
  }
}

/// Lexicographic order in the plane.
bool PlanarGraph::isBefore(VertexId u, VertexId v, Predicates& predicates) const {
  const int first = vertices_->compare(u, v, (axis_ + 1) % 3, predicates);
  return first != 0 ? first < 0 : vertices_->compare(u, v, (axis_ + 2) % 3, predicates) < 0;
}

/// The cycle that runs around a component from outside: it passes the component's first vertex where the rest lies to the right.
PlanarGraph::Cycle PlanarGraph::exteriorCycle(const std::vector<GraphVertex>& component, Predicates& predicates) {
  GraphVertex first = component[0];
  for (const GraphVertex v : component) {
    if (isBefore(ids_[v], ids_[first], predicates)) first = v;
  }
  const std::span<const HalfEdge> out = out_[first];
  HalfEdge last = out[0];  // the one farthest counter-clockwise
  for (const HalfEdge h : out.subspan(1)) {
    const VertexId from = origin(last.twin()), to = origin(h.twin());
    const int turn = vertices_->orient(ids_[first], from, to, axis_, predicates);
    if (turn == 0) vertices_->failSelfIntersectionAt(from, to);
    if (turn > 0) last = h;
  }
  return cycleOf_[last];
}

/// P5: gives every cycle its face. Cycles of the outline's component are faces of their own; a component that floats inside the
/// square has one cycle around it, which belongs to the face that holds the component.
void PlanarGraph::placeComponents(Predicates& predicates) {
  faceOf_.assign(cycleStarts_.size(), kUnset);
  faceOf_[cycleOf_[HalfEdge{1}]] = kOutside;
  faceCount = 0;
  findFloating(predicates);
  for (const Cycle c : faceOf_.ids()) {
    if (faceOf_[c] == kUnset && !isExterior_[c]) faceOf_[c] = {faceCount++};
  }
  if (floating_.empty()) return;
  findHolders(predicates);
  // The innermost holder is the one whose component is itself held most often; the outline's is held by none.
  const auto depthOf = [&](Cycle cycle) {
    const uint32_t component = componentOf_[ends_[cycleStarts_[cycle]]];
    return component < floating_.size() ? floating_[component].holders.size() : 0;
  };
  for (const Floating& component : floating_) {
    Cycle innermost = kNoCycle;
    for (const Cycle c : component.holders) {
      if (innermost == kNoCycle || depthOf(c) > depthOf(innermost)) innermost = c;
    }
    if (innermost == kNoCycle || depthOf(innermost) + 1 != component.holders.size()) {  // loops that cross
      const VertexId other = component.holders.empty() ? ids_[GraphVertex{0}] : origin(cycleStarts_[component.holders.back()]);
      vertices_->failSelfIntersectionAt(ids_[component.members[0]], other);
    }
    faceOf_[component.exterior] = faceOf_[innermost];
  }
}

/// The components that do not reach the outline.
void PlanarGraph::findFloating(Predicates& predicates) {
  floating_.clear();
  isExterior_.assign(cycleStarts_.size(), 0);
  components_.reset(ids_.size());
  for (HalfEdge h{0}; h.number < ends_.size(); h.number += 2) components_.unite(ends_[h], ends_[h.twin()]);
  const Ids<GraphVertex> inside(sides_, ids_.size());
  std::vector<GraphVertex> roots;
  for (const GraphVertex v : inside) {
    if (components_.find(v) == v) roots.push_back(v);
  }
  if (roots.empty()) return;
  floating_.resize(roots.size());
  componentOf_.assign(ids_.size(), uint32_t(roots.size()));  // the outline's, unless found to float
  for (const GraphVertex v : inside) {
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
  IdVector<GraphVertex, CutVertices::Range> rangeP(ids_.size()), rangeQ(ids_.size());
  for (const GraphVertex v : ids_.ids()) {
    rangeP[v] = vertices_->range(ids_[v], p, predicates);
    rangeQ[v] = vertices_->range(ids_[v], q, predicates);
  }
  IdVector<Cycle, uint8_t> odd(cycleStarts_.size(), 0);
  for (uint32_t k = 0; k < floating_.size(); ++k) {
    const GraphVertex v = floating_[k].members[0];
    std::fill(odd.begin(), odd.end(), uint8_t(0));
    const auto above = [&](GraphVertex u) {
      return rangeQ[u].low > rangeQ[v].high || (rangeQ[u].high >= rangeQ[v].low && vertices_->compare(ids_[u], ids_[v], q, predicates) > 0);
    };
    for (HalfEdge h{0}; h.number < ends_.size(); h.number += 2) {
      GraphVertex low = ends_[h], high = ends_[h.twin()];
      if (componentOf_[low] == k || std::max(rangeP[low].high, rangeP[high].high) < rangeP[v].low) continue;
      if (above(low) == above(high)) continue;
      if (above(low)) std::swap(low, high);
      const int side = vertices_->orient(ids_[low], ids_[high], ids_[v], axis_, predicates);
      if (side == 0) vertices_->failSelfIntersectionAt(ids_[v], ids_[low]);
      if (side < 0) continue;
      odd[cycleOf_[h]] ^= 1;
      odd[cycleOf_[h.twin()]] ^= 1;
    }
    for (const Cycle c : odd.ids()) {
      if (odd[c] && faceOf_[c] != kOutside && !isExterior_[c]) floating_[k].holders.push_back(c);
    }
  }
}

/// Traces the cycles again, maybe without slits, and puts the outer loop of each face first.
void PlanarGraph::traceLoops(Predicates& predicates) {
  loopStarts.clear();
  loopFaces.clear();
  traced_.assign(ends_.size(), 0);
  for (const HalfEdge start : ends_.ids()) {
    if (traced_[start] || (slits_ == Slits::out && isSlit(start)) || face(start) == kOutside) continue;
    for (HalfEdge h = start; !traced_[h]; h = next(h)) traced_[h] = 1;
    loopStarts.push_back(start);
    loopFaces.push_back(face(start));
  }
  bool inOrder = true;  // one loop for each face, as nearly always
  for (size_t l = 0; l < loopFaces.size(); ++l) inOrder &= loopFaces[l].number == l;
  if (inOrder) return;
  std::vector<uint32_t> order(loopStarts.size());
  for (uint32_t l = 0; l < order.size(); ++l) order[l] = l;
  sortItems(order, [&](uint32_t a, uint32_t b) { return loopFaces[a] < loopFaces[b]; });
  for (size_t i = 0, end; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && loopFaces[order[end]] == loopFaces[order[i]];) ++end;
    if (end - i == 1) continue;
    size_t outer = i;  // the outer loop has the first vertex of all
    VertexId first = origin(loopStarts[order[i]]);
    for (size_t l = i; l < end; ++l) {
      HalfEdge h = loopStarts[order[l]];
      do {
        if (origin(h) != first && isBefore(origin(h), first, predicates)) {
          first = origin(h);
          outer = l;
        }
        h = next(h);
      } while (h != loopStarts[order[l]]);
    }
    std::rotate(order.begin() + i, order.begin() + outer, order.begin() + outer + 1);
  }
  std::vector<HalfEdge> starts;
  std::vector<Face> faces;
  for (const uint32_t l : order) {
    starts.push_back(loopStarts[l]);
    faces.push_back(loopFaces[l]);
  }
  loopStarts.swap(starts);
  loopFaces.swap(faces);
}

std::optional<PlanarGraph::HalfEdge> PlanarGraph::find(VertexId from, VertexId to) const {
  const auto known = [&](VertexId id) { return localTable_[id].number < ids_.size() && ids_[localTable_[id]] == id; };
  if (!known(from) || !known(to)) return {};
  for (const HalfEdge h : out_[localTable_[from]]) {
    if (origin(h.twin()) == to) return h;
  }
  return {};
}

}  // namespace mandoline::detail
