#include "cut/stages/chains.h"

namespace mandoline::detail {

bool Chains::trace(uint32_t sides, std::span<const GraphVertex> ends, size_t vertices) {
  if (!link(sides, ends, vertices)) return false;
  const size_t edges = ends.size() / 2;
  beside.assign(2 * edges, kNone);
  traced_.assign(sides, 0);
  loops.offsets.assign(1, 0);
  loops.items.clear();
  passes_ = 0;
  for (uint32_t side = 0; side < sides; ++side) {
    if (!traced_[side] && !traceFace(side, sides, ends)) return false;
  }
  return passes_ == 2 * (edges - sides);  // else some float
}

/// False unless vertices of the outline have one edge inside at most, and vertices inside two.
bool Chains::link(uint32_t sides, std::span<const GraphVertex> ends, size_t vertices) {
  links_.assign(2 * vertices, kNone);
  for (size_t end = 2 * size_t(sides); end < ends.size(); ++end) {
    uint32_t* link = &links_[2 * size_t(ends[end].number)];
    if (*link != kNone && (ends[end].number < sides || *++link != kNone)) return false;
    *link = uint32_t(end / 2);
  }
  for (size_t v = sides; v < vertices; ++v) {
    if (links_[2 * v + 1] == kNone) return false;
  }
  return true;
}

/// Counter-clockwise, from an edge of the outline on: where a chain begins, along it.
bool Chains::traceFace(uint32_t first, uint32_t sides, std::span<const GraphVertex> ends) {
  const uint32_t face = uint32_t(loops.size());
  uint32_t at = first;
  do {
    traced_[at] = 1;
    beside[2 * size_t(at)] = face;
    loops.items.push_back({at});
    at = at + 1 < sides ? at + 1 : 0;
    uint32_t edge = links_[2 * size_t(at)];
    if (edge == kNone) continue;
    if (beside[2 * size_t(edge)] == face || beside[2 * size_t(edge) + 1] == face) return false;  // on both sides of the chain
    for (;;) {
      loops.items.push_back({at});
      ++passes_;
      const bool forward = ends[2 * size_t(edge)].number == at;
      beside[2 * size_t(edge) + !forward] = face;
      at = ends[2 * size_t(edge) + forward].number;
      if (at < sides) break;
      const uint32_t* links = &links_[2 * size_t(at)];
      edge = links[links[0] == edge ? 1 : 0];
    }
  } while (at != first);
  loops.endGroup();
  return loops[face].size() >= 3;
}

}  // namespace mandoline::detail
