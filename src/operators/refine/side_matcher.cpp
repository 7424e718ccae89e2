#include "operators/refine/side_matcher.h"

namespace mandoline::refining {

void SideMatcher::clear() {
  edges_.clear();
  largeEdges_.clear();
  surface_.clear();
  links_.clear();
  classes_.clear();
  kinds_.offsets.assign(1, 0);
  kinds_.items.clear();
}

uint32_t SideMatcher::kindOf(std::span<const uint32_t> parents) {
  for (size_t k = 0; k < kinds_.size(); ++k) {
    const std::span<const uint32_t> kind = kinds_[k];
    if (std::equal(kind.begin(), kind.end(), parents.begin(), parents.end())) return uint32_t(k);
  }
  kinds_.items.insert(kinds_.items.end(), parents.begin(), parents.end());
  kinds_.endGroup();
  return uint32_t(kinds_.size() - 1);
}

size_t SideMatcher::addFace(std::span<const uint32_t> parents) {
  classes_.push_back(kindOf(parents));
  return classes_.size() - 1;
}

void SideMatcher::addLargeEdge(uint32_t from, uint32_t to, std::span<const uint32_t> parents, int32_t cell) {
  largeEdges_.push_back({from, to, kindOf(parents), cell});
}

void SideMatcher::run(const std::vector<uint8_t>& isLarge, ChainList& chains) {
  detail::sortItems(edges_);
  detail::sortItems(largeEdges_);
  detail::sortUnique(surface_);
  sets_.reset(classes_.size());
  cells_.assign(classes_.size(), -1);
  joinFaces();
  for (const auto& [a, b] : surface_) links_.insert(links_.end(), {{a, b}, {b, a}});
  detail::sortUnique(links_);
  for (const auto& [from, next] : links_) {
    if (isLarge[from]) trace(from, next, isLarge, chains);
  }
}

/// Faces are in one of the larger block's if what is between them is no triangle, and if they are pieces of the same triangles, or of none.
void SideMatcher::joinFaces() {
  for (const Edge& edge : edges_) {
    if (joinAcross(edge)) continue;
    links_.push_back({edge.from, edge.to});
    links_.push_back({edge.to, edge.from});
  }
}

bool SideMatcher::joinAcross(const Edge& edge) {
  const Pair pair = {std::min(edge.from, edge.to), std::max(edge.from, edge.to)};
  if (std::binary_search(surface_.begin(), surface_.end(), pair)) return false;
  const Edge back = {edge.to, edge.from, 0};
  const auto twin = std::lower_bound(edges_.begin(), edges_.end(), back);
  if (twin == edges_.end() || twin->from != back.from || twin->to != back.to) return false;
  if (classes_[twin->face] != classes_[edge.face]) return false;
  sets_.unite(edge.face, twin->face);
  return true;
}

std::span<const SideMatcher::Pair> SideMatcher::linksOf(uint32_t vertex) const {
  const auto first = std::lower_bound(links_.begin(), links_.end(), Pair{vertex, 0});
  auto past = first;
  while (past != links_.end() && (*past)[0] == vertex) ++past;
  return {links_.data() + (first - links_.begin()), size_t(past - first)};
}

/// Follows a line from a vertex of larger cells to the next one: at a vertex of smaller cells alone it goes on, since there it crosses
/// nothing but planes of theirs.
void SideMatcher::trace(uint32_t from, uint32_t next, const std::vector<uint8_t>& isLarge, ChainList& chains) {
  chain_.assign(1, from);
  uint32_t before = from, at = next;
  while (!isLarge[at]) {
    const std::span<const Pair> links = linksOf(at);
    if (links.size() != 2 || chain_.size() > links_.size()) return;
    chain_.push_back(at);
    const uint32_t after = links[0][1] == before ? links[1][1] : links[0][1];
    before = at;
    at = after;
  }
  if (at == from) return;
  if (chain_.size() > 1) {
    chain_.push_back(at);
    chains.items.insert(chains.items.end(), chain_.begin(), chain_.end());
    chains.endGroup();
  }
  match(from, next, at);
}

/// The faces on the left of an edge, and so all around, are in that of the larger block on the left of its edge.
void SideMatcher::match(uint32_t from, uint32_t next, uint32_t to) {
  for (auto edge = std::lower_bound(edges_.begin(), edges_.end(), Edge{from, next, 0});
       edge != edges_.end() && edge->from == from && edge->to == next; ++edge) {
    const LargeEdge sought = {from, to, classes_[edge->face], 0};
    const auto found = std::lower_bound(largeEdges_.begin(), largeEdges_.end(), sought);
    if (found == largeEdges_.end() || sought < *found) continue;
    cells_[sets_.find(edge->face)] = found->cell;
  }
}

}  // namespace mandoline::refining
