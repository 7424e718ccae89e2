#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

namespace {

/// Whether all bricks that have a grid element are kept, one of which is. So vertices on one element are kept together or not at all: see
/// separate.h.
bool isKept(const Bricks& bricks, const KeptBricks& kept, const Slab& element) {
  if (!bricks.grid.isOnSeam(element)) return true;
  bool is = true;
  bricks.grid.forBricks(element, [&](const Slab& cell) {
    const std::optional<BrickId> brick = bricks.find(cell);
    is &= !brick || kept.has(*brick);
  });
  return is;
}

}  // namespace

std::vector<uint32_t> findKeptVertices(const CutBricks& cut, const KeptBricks& kept, const Numbers& before, const Numbers& now) {
  std::vector<uint32_t> result(size_t(now.surfaceVertices) + now.total.vertices, Numbers::kUnused);
  for (const VertexId was : kept.vertices.ids()) {
    const VertexId v = kept.vertices[was];
    const uint32_t number = v == KeptBricks::kNoVertex ? Numbers::kUnused : now.ofSurface[v];
    if (number != Numbers::kUnused) result[number] = before.ofSurface[was];
  }
  const auto isElementKept = [&](const Slab& element) { return isKept(cut.bricks, kept, element); };
  for (const BrickId b : cut.bricks.ids()) {
    const bool isBrickKept = kept.has(b), isInner = kept.isInner(b);
    if (!isInner) {
      for (const VertexId v : cut.cuts[b].surfaceVertices) {
        if (!isBrickKept || !isElementKept(cut.surface.vertices.slab(v))) result[now.ofSurface[v]] = Numbers::kUnused;
      }
    }
    if (!isBrickKept) continue;
    const std::vector<uint32_t>&was = before.ofBrick[kept.before[b]], &is = now.ofBrick[b];
    const auto& slabs = cut.cuts[b].vertices.slabs;
    for (size_t i = 0; i < is.size(); ++i) {
      if (is[i] != Numbers::kUnused && (isInner || isElementKept(slabs[i]))) result[is[i]] = was[i];
    }
  }
  return result;
}

}  // namespace mandoline::detail
