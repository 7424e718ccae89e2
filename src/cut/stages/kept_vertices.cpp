#include "cut/stages/kept_vertices.h"

namespace mandoline::detail {

std::vector<uint32_t> findKeptVertices(const CutBricks& cut, const KeptBricks& kept, const Numbers& before, const Numbers& now) {
  std::vector<uint32_t> result(size_t(now.surfaceVertices) + now.total.vertices, Numbers::kUnused);
  const auto note = [&](uint32_t numberBefore, uint32_t number) {
    if (numberBefore != Numbers::kUnused && number != Numbers::kUnused) result[number] = numberBefore;
  };
  for (const VertexId v : kept.vertices.ids()) {
    if (kept.vertices[v] != KeptBricks::kNoVertex) note(before.ofSurface[v], now.ofSurface[kept.vertices[v]]);
  }
  for (const BrickId b : cut.bricks.ids()) {
    if (!kept.has(b)) continue;
    const std::vector<uint32_t>&was = before.ofBrick[kept.before[b]], &is = now.ofBrick[b];
    for (size_t i = 0; i < is.size(); ++i) note(was[i], is[i]);
  }
  // On seams it may have come nearer to one that has moved: see separate() in output_part.cpp.
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
