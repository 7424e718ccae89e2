#include "cut/contradiction.h"

#include <string>

#include "mesh/box_tree.h"
#include "mesh/intersections.h"

namespace mandoline::detail {
namespace {

/// Triangles that have no part in the cut because the grid ends before them can't have led to a contradiction.
bool reachesGrid(const Input& input, uint32_t t) {
  const auto& v = input.triangles[t];
  for (int d = 0; d < 3; ++d) {
    const int32_t a = input.slabs[v[0]][d], b = input.slabs[v[1]][d], c = input.slabs[v[2]][d];
    if (std::max({a, b, c}) < 0 || std::min({a, b, c}) > 2 * input.cells(d)) return false;
  }
  return true;
}

}  // namespace

Error explainContradiction(const Input& input, int64_t blamed, int64_t alsoBlamed, const CutStats& stats) {
  const auto name = [&](int64_t s, int64_t t) {
    const int64_t low = std::min(s, t), high = std::max(s, t);
    return Error{Status::selfIntersection, low, high,
                 "Triangles " + std::to_string(low) + " and " + std::to_string(high) + " meet other than in a shared vertex or edge" +
                     (stats.snappedVertices > 0 ? " after snapping." : ".")};
  };
  const auto isCandidate = [&](int64_t t) { return t >= 0 && input.kept(size_t(t)); };
  Intersections intersections(input);
  if (isCandidate(blamed) && isCandidate(alsoBlamed) && blamed != alsoBlamed &&
      intersections.meet(uint32_t(blamed), uint32_t(alsoBlamed))) {
    return name(blamed, alsoBlamed);
  }
  std::vector<uint32_t> candidates;
  for (uint32_t t = 0; t < input.triangles.size(); ++t) {
    if (input.kept(t) && reachesGrid(input, t)) candidates.push_back(t);
  }
  const BoxTree tree(input, candidates);
  const auto lowestPartner = [&](uint32_t t, uint32_t from) {
    int64_t lowest = -1;
    tree.forOverlapping(boxOf(input, t), [&](uint32_t s) {
      if (s >= from && s != t && (lowest < 0 || s < lowest) && intersections.meet(s, t)) lowest = s;
    });
    return lowest;
  };
  for (const int64_t t : {blamed, alsoBlamed}) {
    const int64_t partner = isCandidate(t) ? lowestPartner(uint32_t(t), 0) : -1;
    if (partner >= 0) return name(t, partner);
  }
  for (const uint32_t t : candidates) {
    const int64_t partner = lowestPartner(t, t + 1);
    if (partner >= 0) return name(t, partner);
  }
  return {Status::internalError, -1, -1,
          "The cut met a contradiction although no two triangles intersect. This is a fault of the library."};
}

}  // namespace mandoline::detail
