#include "mesh/prepare_again.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mandoline::detail {
namespace {

/// Whether two meshes differ in nothing but coordinates. Not where triangles had no area: they put vertices on the sides of others.
bool areConnectedAlike(const Prepared& before, const Prepared& now) {
  return before.counts.zeroAreaTriangles == 0 && before.shift == now.shift && before.triVertices == now.triVertices &&
         before.triangles.size() == now.triangles.size() && !now.triangles.empty() &&
         std::memcmp(before.triangles.data(), now.triangles.data(), sizeof before.triangles[0] * now.triangles.size()) == 0;
}

/// 0 is not -0: both may be handed on to positions.
bool areSameBits(const Point& a, const Point& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
/// A coordinate that was flushed may be another one.
bool hasZero(const Point& p) { return p[0] == 0 || p[1] == 0 || p[2] == 0; }

/// Empty if nothing is known.
Moved findMoved(const Prepared& before, const Prepared& now) {
  Moved moved;
  if (!areConnectedAlike(before, now)) return moved;
  moved.resize(now.points.size());
  const bool areFlushed = before.counts.flushedCoordinates + now.counts.flushedCoordinates > 0;
  for (const VertexId v : moved.ids()) moved[v] = !areSameBits(before.point(v), now.point(v)) || (areFlushed && hasZero(now.point(v)));
  return moved;
}

/// The triangles that have, ascending.
std::vector<uint32_t> listMoved(const Prepared& mesh, const Moved& moved) {
  std::vector<uint32_t> list;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (hasMoved(moved, mesh.triangles[t])) list.push_back(t);
  }
  return list;
}

/// Per point a bit for each side of a box that it lies beyond.
std::vector<uint8_t> sidesBeyond(const Box& box, const std::vector<Point>& points) {
  std::vector<uint8_t> sides(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const auto sideOf = [&](size_t d) { return int(points[i][d] < box.low[d]) | int(points[i][d] > box.high[d]) << 1; };
    sides[i] = uint8_t(sideOf(0) | sideOf(1) << 2 | sideOf(2) << 4);
  }
  return sides;
}

/// The triangles that lie near those that have moved, these included, ascending. Those that these meet are among them.
std::vector<uint32_t> nearMoved(const Prepared& mesh, const std::vector<uint32_t>& movedTriangles) {
  Box all = Box::empty();
  for (const uint32_t t : movedTriangles) all.include(boxOf(mesh, t));
  const std::vector<uint8_t> beyond = sidesBeyond(all, mesh.points);
  std::vector<uint32_t> near(mesh.triangles.size());
  size_t count = 0;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const bool isBeside = (beyond[v[0]] & beyond[v[1]] & beyond[v[2]]) != 0;  // its box doesn't overlap
    near[count] = t;
    count += mesh.states[t] == TriangleState::kept && !isBeside;
  }
  near.resize(count);
  return near;
}

/// What has moved.
struct Changes {
  Moved vertices;
  std::vector<uint32_t> triangles;
};

struct Means {
  Monitor& monitor;
  Predicates& predicates;
};

/// The contacts of what has not moved are those before.
Contacts findContactsAgain(const Prepared& before, const Prepared& now, const Changes& changes, const Means& means) {
  const Moved& moved = changes.vertices;
  const auto isNew = [&](const PairContact& pair) {
    return hasMoved(moved, now.triangles[pair.triangles[0]]) || hasMoved(moved, now.triangles[pair.triangles[1]]);
  };
  std::vector<PairContact> pairs = before.contacts;
  std::erase_if(pairs, isNew);
  SortedMesh near(now, nearMoved(now, changes.triangles));
  for (const PairContact& pair : findContacts(now, findNear(std::move(near), means.monitor), means.monitor, means.predicates).pairs) {
    if (isNew(pair)) pairs.push_back(pair);
  }
  return contactsOf(now, std::move(pairs));
}

/// As resolveInput(). False if triangles meet that should not.
bool resolveAgain(Prepared& before, Prepared& now, const Changes& changes, Intersections intersections, const Means& means) {
  now.states = before.states;
  now.duplicates = before.duplicates;
  now.closed = before.closed;
  now.oriented = before.oriented;
  Contacts contacts;
  if (intersections != Intersections::assumeNone) contacts = findContactsAgain(before, now, changes, means);
  if (intersections == Intersections::refuse && contacts.counts.total() > 0) return false;
  if (!before.hasIntersections()) {
    if (contacts.pairs.empty() && before.duplicates.empty()) {
      now.edges = std::move(before.edges);  // which arrangeInput() leaves
    } else {
      now.edges = before.edges;
    }
    now.parts = before.parts;
  } else if (contacts.pairs.empty()) {
    now.states.assign(now.states.size(), TriangleState::kept);
    now.duplicates.clear();
    findInputEdges(now);
  }
  if (intersections == Intersections::resolve) arrangeInput(now, std::move(contacts), true, means.monitor, means.predicates);
  return true;
}

}  // namespace

PreparedAgain prepareAgain(const MeshView& mesh, const Preparation& preparation, Prepared& before, Monitor& monitor,
                           const std::function<void(const char*)>& beginStage) {
  Predicates predicates;
  beginStage("input");
  auto now = weldAgain(mesh, preparation.largest, before, monitor);
  Changes changes{findMoved(before, *now), {}};
  Moved& moved = changes.vertices;
  if (!moved.empty()) changes.triangles = listMoved(*now, moved);
  dropFlat(*now, moved.empty() ? nullptr : &changes.triangles, monitor, predicates);
  if (now->counts.zeroAreaTriangles > 0) moved.clear();
  if (preparation.intersections != Intersections::assumeNone) beginStage("intersections");
  if (moved.empty() || !resolveAgain(before, *now, changes, preparation.intersections, {monitor, predicates})) {
    moved.clear();
    resolveInput(*now, preparation, monitor, predicates);
  }
  now->counts.exactFallbacks = predicates.fallbacks;
  return {std::move(now), std::move(moved)};
}

}  // namespace mandoline::detail
