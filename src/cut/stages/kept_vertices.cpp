#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

/// Whether all bricks that have a grid element are kept. So vertices on one element are kept together or not at all: see separate.h.
static bool isKept(const CutBricks& cut, const KeptBricks& kept, const Slab& element) {
  bool is = true;
  cut.bricks.grid.forBricks(element, [&](const Slab& cell) {
    const std::optional<BrickId> brick = cut.bricks.find(cell);
    is &= !brick || kept.has(*brick);
  });
  return is;
}

std::vector<uint32_t> findKeptVertices(const CutBricks& cut, const KeptBricks& kept, const Numbers& before, const Numbers& now) {
  std::vector<uint32_t> result(size_t(now.surfaceVertices) + now.total.vertices, Numbers::kUnused);
  const auto note = [&](uint32_t numberBefore, uint32_t number, const Slab& element, bool isOfKept) {
    if (numberBefore == Numbers::kUnused || number == Numbers::kUnused) return;  // outside of the grid, for one
    if ((isOfKept && !cut.bricks.grid.isOnSeam(element)) || isKept(cut, kept, element)) result[number] = numberBefore;
  };
  for (const VertexId was : kept.vertices.ids()) {
    const VertexId v = kept.vertices[was];
    if (v != KeptBricks::kNoVertex) note(before.ofSurface[was], now.ofSurface[v], cut.surface.vertices.slab(v), false);
  }
  for (const BrickId b : cut.bricks.ids()) {
    if (!kept.has(b)) continue;
    const std::vector<uint32_t>&was = before.ofBrick[kept.before[b]], &is = now.ofBrick[b];
    const auto& slabs = cut.cuts[b].vertices.slabs;
    for (size_t i = 0; i < is.size(); ++i) note(was[i], is[i], slabs[i], true);
  }
  return result;
}

}  // namespace mandoline::detail
