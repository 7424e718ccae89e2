#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

/// Whether a vertex of the surface lies on a seam of a brick that is cut again, which need not have it in a loop.
static bool isBesideCut(const CutBricks& cut, const KeptBricks& kept, VertexId v) {
  const Slab& slab = cut.surface.vertices.slab(v);
  bool isBeside = false;
  if (cut.bricks.grid.isOnSeam(slab)) {
    cut.bricks.grid.forBricks(slab, [&](const Slab& cell) {
      const std::optional<BrickId> brick = cut.bricks.find(cell);
      isBeside |= brick && !kept.has(*brick);
    });
  }
  return isBeside;
}

std::vector<uint32_t> findKeptVertices(const CutBricks& cut, const KeptBricks& kept, const Numbers& before, const Numbers& now) {
  std::vector<uint32_t> result(size_t(now.surfaceVertices) + now.total.vertices, Numbers::kUnused);
  const auto note = [&](uint32_t numberBefore, uint32_t number) {
    if (numberBefore != Numbers::kUnused && number != Numbers::kUnused) result[number] = numberBefore;
  };
  for (const VertexId was : kept.vertices.ids()) {
    const VertexId v = kept.vertices[was];
    if (v != KeptBricks::kNoVertex && !isBesideCut(cut, kept, v)) note(before.ofSurface[was], now.ofSurface[v]);
  }
  for (const BrickId b : cut.bricks.ids()) {
    if (!kept.has(b)) continue;
    const std::vector<uint32_t>&was = before.ofBrick[kept.before[b]], &is = now.ofBrick[b];
    for (size_t i = 0; i < is.size(); ++i) note(was[i], is[i]);
  }
  // On seams others may be put onto it: see separate() in output_part.cpp.
  for (const BrickId b : cut.bricks.ids()) {
    if (kept.has(b)) continue;
    for (const VertexId v : cut.cuts[b].surfaceVertices) result[now.ofSurface[v]] = Numbers::kUnused;
    for (const uint32_t number : now.ofBrick[b]) {
      if (number != Numbers::kUnused) result[number] = Numbers::kUnused;
    }
  }
  return result;
}

}  // namespace mandoline::detail
