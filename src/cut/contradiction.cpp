#include "cut/contradiction.h"

#include <string>

#include "base/box_tree.h"
#include "mesh/resolve/contacts.h"

namespace mandoline::detail {
namespace {

/// Triangles outside the grid have no part in the cut, so they can't have led to a contradiction.
bool reachesGrid(const Input& input, TriangleId t) {
  const auto v = input.verticesOf(t);
  for (int d = 0; d < 3; ++d) {
    const int32_t a = input.slabs[v[0]][d], b = input.slabs[v[1]][d], c = input.slabs[v[2]][d];
    if (std::max({a, b, c}) < 0 || std::min({a, b, c}) > 2 * input.cells(d)) return false;
  }
  return true;
}

}  // namespace

Error explainContradiction(const Input& input, int64_t blamed, int64_t alsoBlamed, Run& run) {
  if (input.mesh->arrangement) {
    return {Status::internalError, -1, -1,
            "The cut met a contradiction although all intersections had been resolved. This is a fault of the library."};
  }
  const auto name = [&](int64_t s, int64_t t) {
    const int64_t low = std::min(s, t), high = std::max(s, t);
    return Error{Status::selfIntersection, low, high,
                 "Triangles " + std::to_string(low) + " and " + std::to_string(high) + " meet other than in a shared vertex or edge" +
                     (run.stats.snappedVertices > 0 ? " after snapping." : ".")};
  };
  const auto isCandidate = [&](int64_t t) { return t >= 0 && input.mesh->kept(size_t(t)); };
  PairTest pairs(*input.mesh);
  if (isCandidate(blamed) && isCandidate(alsoBlamed) && blamed != alsoBlamed && pairs.meet(uint32_t(blamed), uint32_t(alsoBlamed))) {
    return name(blamed, alsoBlamed);
  }
  std::vector<uint32_t> candidates;
  for (const TriangleId t : input.triangleIds()) {
    if (input.kept(t) && reachesGrid(input, t)) candidates.push_back(t.number);
  }
  BoxTree tree;
  tree.build(candidates.size(), [&](size_t i) { return BoxTree::Item{boxOf(*input.mesh, candidates[i]), candidates[i]}; });
  const auto lowestPartner = [&](uint32_t t, uint32_t from) {
    int64_t lowest = -1;
    tree.forOverlapping(boxOf(*input.mesh, t), [&](uint32_t s) {
      if (s >= from && s != t && (lowest < 0 || s < lowest) && pairs.meet(s, t)) lowest = s;
    });
    return lowest;
  };
  for (const int64_t t : {blamed, alsoBlamed}) {
    const int64_t partner = isCandidate(t) ? lowestPartner(uint32_t(t), 0) : -1;
    if (partner >= 0) return name(t, partner);
  }
  constexpr size_t kBlock = 1024;  // triangles between two reports
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (i % kBlock == 0) run.monitor.report(i, candidates.size());
    const int64_t partner = lowestPartner(candidates[i], candidates[i] + 1);
    if (partner >= 0) return name(candidates[i], partner);
  }
  return {Status::internalError, -1, -1,
          "The cut met a contradiction although no two triangles intersect. This is a fault of the library."};
}

}  // namespace mandoline::detail
