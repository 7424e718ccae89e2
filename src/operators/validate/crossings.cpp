// Faces meet only in shared vertices and edges. Where two cross or lie on each other, one of these happens:
// - an edge passes through a face,
// - two edges cross,
// - a vertex lies inside an edge (see conforming.cpp),
// - an edge lies in a face that it does not bound,
// - two faces have a segment in common whose ends are vertices of one in the plane of the other,
// - two faces have the same outline.
// Rounded places find what may meet; where they leave open on which side of something a point lies, its exact place decides (spots.h).
#include <algorithm>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {
namespace {

/// The side of the line from a to b that p lies on, seen along an axis; 0 where rounding leaves it open.
int sideOfLine(const Vec3& a, const Vec3& b, const Vec3& p, int axis, const Vec3& margin) {
  const int e = (axis + 1) % 3, f = (axis + 2) % 3;
  const Vec3 along = b - a, to = p - a;
  const double left = along[e] * to[f] - along[f] * to[e];
  const double doubt = margin[f] * (std::fabs(along[e]) + std::fabs(to[e])) + margin[e] * (std::fabs(along[f]) + std::fabs(to[f]));
  return std::fabs(left) > doubt ? (left > 0 ? 1 : -1) : 0;
}

using SpotPair = std::array<const Spot*, 2>;

/// Whether two segments cross, seen along an axis.
bool doCross(const Context& x, const SpotPair& one, const SpotPair& other, int axis) {
  const auto separates = [&](const SpotPair& line, const SpotPair& ends) {
    const int side = turn(x, {line[0], line[1], ends[0]}, axis);
    return side != 0 && turn(x, {line[0], line[1], ends[1]}, axis) == -side;
  };
  return separates(one, other) && separates(other, one);
}

}  // namespace

void CrossingCheck::run(const GridCell& cell, const std::vector<Edge>& edges, CellSpots& spots) {
  spots_ = &spots;
  margin_ = kTolerance * cell.noise;
  finePlanes_.start(cell.faces.size()), sides_.start(cell.places.size());
  gatherPlanes(cell);
  gatherSegments(cell, edges);
  hubs_.find(cell, edges);
  buildTrees(cell);
  for (uint32_t e = 0; e < segments_.size(); ++e) {
    segmentTree_.forOverlapping(boxOf(segments_[e], margin_), segments_[e].ends, [&](uint32_t other) {
      if (other > e) checkEdges(cell, segments_[e], segments_[other]);
    });
  }
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    const GridCell::Face& face = cell.faces[f];
    if (cell.context.cut.faceTriangle[face.id] < 0) continue;
    const detail::Box box = validation::boxOf(face.low - margin_, face.high + margin_);
    segmentTree_.forOverlapping(box, cell.vertices(f), [&](uint32_t e) { checkEdgeAndFace(cell, segments_[e], f); });
    if (face.side >= 0) continue;
    faceTree_.forOverlapping(box, cell.vertices(f), [&](uint32_t g) {
      if (g > f) checkFaces(cell, f, g);
    });
  }
  for (const Hubs::Hub& hub : hubs_.all()) checkAbout(cell, hub);
}

void CrossingCheck::buildTrees(const GridCell& cell) {
  faceTree_.clear(), segmentTree_.clear();
  for (uint32_t f = 0; f < cell.faces.size(); ++f) {
    const GridCell::Face& face = cell.faces[f];
    if (cell.context.cut.faceTriangle[face.id] >= 0) faceTree_.add({validation::boxOf(face.low, face.high), f});
  }
  for (uint32_t e = 0; e < segments_.size(); ++e) segmentTree_.add({boxOf(segments_[e], {}), e});
  faceTree_.build(hubs_, [&](uint32_t f) { return cell.vertices(f); });
  segmentTree_.build(hubs_, [&](uint32_t e) { return std::span<const uint32_t>(segments_[e].ends); });
}

/// Edges and faces that share a hub. Triangles that also meet elsewhere are found by their edges, unless they are the same.
void CrossingCheck::checkAbout(const GridCell& cell, const Hubs::Hub& hub) {
  const Vec3 from = cell.placeOf(hub.vertex);
  const auto directionsOfFace = [&](uint32_t f) {
    return directionsOf(from, {cell.corners.data() + cell.faces[f].firstCorner, cell.vertices(f).size()}, margin_);
  };
  directionTree_.build(hub.faces.size(), [&](size_t i) {
    return detail::BoxTree::Item{directionsOfFace(hub.faces[i].item), hub.faces[i].item};
  });
  for (const auto& [vertex, e] : hub.edges) {
    const Segment& edge = segments_[e];
    const Vec3 ends[2] = {edge.from, edge.to};
    directionTree_.forOverlapping(directionsOf(from, ends, margin_), [&](uint32_t f) { checkEdgeAndFace(cell, edge, f); });
  }
  for (const auto& [vertex, item] : hub.faces) {
    const uint32_t f = item;
    directionTree_.forOverlapping(directionsOfFace(f), [&](uint32_t g) {
      const bool triangles = cell.vertices(f).size() == 3 && cell.vertices(g).size() == 3;
      if (g > f && (!triangles || planes_[f].vertices == planes_[g].vertices)) checkFaces(cell, f, g);
    });
  }
}

void CrossingCheck::gatherPlanes(const GridCell& cell) {
  planes_.assign(cell.faces.size(), {});
  for (size_t f = 0; f < planes_.size(); ++f) {
    const GridCell::Face& face = cell.faces[f];
    const int32_t t = cell.context.cut.faceTriangle[face.id];
    if (t < 0) continue;
    Plane& plane = planes_[f];
    const Normal normal = cell.context.triangleNormal(size_t(t));
    for (int d = 0; d < 3; ++d) {
      const double n = normal.n[d] * cell.size[d];
      plane.normal[d] = n;
      plane.doubt += normal.error[d] * cell.size[d] + kTolerance * cell.noise[d] * std::fabs(n);
    }
    plane.origin = cell.corners[face.firstCorner];
    for (uint32_t i = face.firstCorner; i < face.lastCorner; ++i) plane.vertices += Random::mix(cell.cornerVertex[i]);
  }
}

void CrossingCheck::gatherSegments(const GridCell& cell, const std::vector<Edge>& edges) {
  segments_.clear();
  for (const Edge& edge : edges) {
    segments_.push_back({edge, cell.placeOf(edge[0]), cell.placeOf(edge[1])});
  }
}

detail::Box CrossingCheck::boxOf(const Segment& segment, const Vec3& margin) {
  Vec3 low, high;
  for (int d = 0; d < 3; ++d) {
    low[d] = std::min(segment.from[d], segment.to[d]) - margin[d], high[d] = std::max(segment.from[d], segment.to[d]) + margin[d];
  }
  return validation::boxOf(low, high);
}

void CrossingCheck::checkEdgeAndFace(const GridCell& cell, const Segment& edge, uint32_t f) {
  const GridCell::Face& face = cell.faces[f];
  const Plane& plane = planes_[f];
  const double h = plane.height(edge.from), k = plane.height(edge.to);
  if (std::min(h, k) > plane.doubt || std::max(h, k) < -plane.doubt) return;
  const int low = sideOf(cell, edge.ends[0], h, f), high = sideOf(cell, edge.ends[1], k, f);
  if (low * high > 0 || (low == 0) != (high == 0)) return;
  if (low != 0) {
    if (passesThrough(cell, edge, h / (h - k), f)) crossings_.violate("face", face.id, "is crossed by an edge");
  } else if (holdsMiddle(cell, edge, f)) {
    crossings_.violate("face", face.id, "has an edge on it that does not bound it");
  }
}

/// Whether an edge from one side of a face's plane to the other meets it inside of the face.
bool CrossingCheck::passesThrough(const GridCell& cell, const Segment& edge, double share, uint32_t f) {
  const Context& x = cell.context;
  const GridCell::Face& face = cell.faces[f];
  const Plane& plane = planes_[f];
  const int axis = dominantAxis(plane.normal);
  const Vec3 along = edge.to - edge.from;
  const double height = std::fabs(dot(along, plane.normal));
  if (height > 2 * plane.doubt) {
    Vec3 margin;
    for (int d = 0; d < 3; ++d) margin[d] = margin_[d] + 2 * plane.doubt / height * std::fabs(along[d]);
    const Place place = placeOn(cell, face, axis, edge.from + share * along, margin);
    if (place != Place::open) return place == Place::inside;
  }
  return isInside(cell, face, meet(x, spotAt(cell, edge.ends[0]), spotAt(cell, edge.ends[1]), planeAt(cell, f)));
}

/// Whether the middle between two points in a face's plane lies inside of the face.
bool CrossingCheck::holdsMiddle(const GridCell& cell, const Segment& points, uint32_t f) {
  const GridCell::Face& face = cell.faces[f];
  if (bounds(cell, points.ends, face)) return false;
  const Place place = placeOn(cell, face, dominantAxis(planes_[f].normal), 0.5 * (points.from + points.to), margin_);
  if (place != Place::open) return place == Place::inside;
  return isInside(cell, face, middle(spotAt(cell, points.ends[0]), spotAt(cell, points.ends[1])));
}

bool CrossingCheck::bounds(const GridCell& cell, const Edge& edge, const GridCell::Face& face) const {
  for (uint32_t i = face.firstCorner; i < face.lastCorner; ++i) {
    if (edgeOf(cell.cornerVertex[i], cell.cornerVertex[cell.cornerNext[i]]) == edge) return true;
  }
  return false;
}

/// Exact: whether a point in the plane of a face lies inside of it.
bool CrossingCheck::isInside(const GridCell& cell, const GridCell::Face& face, const Spot& point) {
  const Context& x = cell.context;
  const size_t t = size_t(x.cut.faceTriangle[face.id]);
  int axis = 0;
  while (axis < 2 && x.sideOf(t, axis) == 0) ++axis;
  const int d = (axis + 1) % 3, e = (axis + 2) % 3;
  bool inside = false;
  for (uint32_t i = face.firstCorner; i < face.lastCorner; ++i) {
    const Spot &a = spotAt(cell, cell.cornerVertex[i]), &b = spotAt(cell, cell.cornerVertex[cell.cornerNext[i]]);
    const int low = compare(x, a, point, e), high = compare(x, b, point, e);
    if (low * high > 0) continue;  // above or below the edge
    const int left = turn(x, {&a, &b, &point}, axis);
    if (left == 0 && compare(x, a, point, d) * compare(x, b, point, d) <= 0) return false;  // on the outline
    if ((low > 0) != (high > 0) && (high > 0) == (left > 0)) inside = !inside;
  }
  return inside;
}

/// The side of a face's plane that a vertex lies on, given its height above it.
int CrossingCheck::sideOf(const GridCell& cell, uint32_t v, double height, uint32_t f) {
  if (std::fabs(height) > planes_[f].doubt) return height > 0 ? 1 : -1;
  const auto corners = cell.cornerVertex.begin(), last = corners + cell.faces[f].lastCorner;
  if (std::find(corners + cell.faces[f].firstCorner, last, v) != last) return 0;
  return sides_.at(cell.context.cut.faceTriangle[cell.faces[f].id], cell.numbers.of(v),
                   [&] { return isIn(cell, v, f) ? 0 : validation::sideOf(cell.context, planeAt(cell, f), spotAt(cell, v)); });
}

const FinePlane& CrossingCheck::planeAt(const GridCell& cell, uint32_t f) {
  const GridCell::Face& face = cell.faces[f];
  const Spot& corner = spotAt(cell, cell.cornerVertex[face.firstCorner]);
  return finePlanes_.at(f, [&] { return finePlane(cell.context, size_t(cell.context.cut.faceTriangle[face.id]), corner); });
}

void CrossingCheck::checkEdges(const GridCell& cell, const Segment& one, const Segment& other) {
  for (const uint32_t v : one.ends) {
    if (v == other.ends[0] || v == other.ends[1]) return;
  }
  const Vec3 a = one.to - one.from, b = other.to - other.from, between = other.from - one.from, normal = cross(a, b);
  const Vec3 byA = cross(b, between), byB = cross(between, a);
  double doubt = 0;
  for (int d = 0; d < 3; ++d) doubt += margin_[d] * (std::fabs(normal[d]) + std::fabs(byA[d]) + std::fabs(byB[d]));
  if (std::fabs(dot(normal, between)) > doubt) return;
  const int axis = dominantAxis(normal);
  const int sides[4] = {sideOfLine(one.from, one.to, other.from, axis, margin_), sideOfLine(one.from, one.to, other.to, axis, margin_),
                        sideOfLine(other.from, other.to, one.from, axis, margin_), sideOfLine(other.from, other.to, one.to, axis, margin_)};
  if (sides[0] * sides[1] > 0 || sides[2] * sides[3] > 0) return;
  const Context& x = cell.context;
  const SpotPair first{&spotAt(cell, one.ends[0]), &spotAt(cell, one.ends[1])};
  const SpotPair second{&spotAt(cell, other.ends[0]), &spotAt(cell, other.ends[1])};
  if (areSurelySkew({first[0], first[1], second[0], second[1]})) return;
  const Residues &p = x.exact[one.ends[0]], &q = x.exact[other.ends[0]];
  if (!areKnown(x, one.ends) || !areKnown(x, other.ends)) return;  // reported elsewhere
  const Residues along = x.exact[one.ends[1]] - p, across = cross(along, x.exact[other.ends[1]] - q);
  if (isZero(across) || !dot(across, q - p).isZero()) return;  // parallel or skew
  const bool certain = sides[0] * sides[1] * sides[2] * sides[3] != 0;
  // Seen along an axis in the plane of both, they are on one line and don't.
  if (certain || doCross(x, first, second, 0) || doCross(x, first, second, 1) || doCross(x, first, second, 2))
    crossings_.violate("vertex", one.ends[0], "is an end of an edge that crosses another edge");
}

bool CrossingCheck::areKnown(const Context& x, const Edge& ends) { return x.exact.isKnown(ends[0]) && x.exact.isKnown(ends[1]); }

void CrossingCheck::checkFaces(const GridCell& cell, uint32_t f, uint32_t g) {
  if (cell.faces[f].side >= 0 || cell.faces[g].side >= 0) return;
  common_.clear();
  const bool fNearG = gatherNear(cell, f, g), gNearF = gatherNear(cell, g, f);
  detail::sortItems(common_, [](const Common& a, const Common& b) { return a.vertex < b.vertex; });
  common_.erase(std::unique(common_.begin(), common_.end(), [](const Common& a, const Common& b) { return a.vertex == b.vertex; }),
                common_.end());
  if (common_.size() < 2 || (common_.size() == 2 && bounds(cell, {common_[0].vertex, common_[1].vertex}, cell.faces[f]))) return;
  if (fNearG && gNearF && haveOnePlane(cell, f, g)) {
    if (planes_[f].vertices == planes_[g].vertices) crossings_.violate("face", cell.faces[g].id, "has the same outline as another one");
    return;
  }
  std::erase_if(common_, [&](const Common& c) { return !isIn(cell, c.vertex, f) || !isIn(cell, c.vertex, g); });
  if (common_.size() > 2) sortAlongLine(cell);
  for (size_t i = 1; i < common_.size(); ++i) {
    const Segment part{edgeOf(common_[i - 1].vertex, common_[i].vertex), common_[i - 1].point, common_[i].point};
    if (holdsMiddle(cell, part, f) && holdsMiddle(cell, part, g))
      return crossings_.violate("face", cell.faces[g].id, "crosses another one between two vertices");
  }
}

/// Sorts the vertices that two faces have in common, which lie on one line.
void CrossingCheck::sortAlongLine(const GridCell& cell) {
  const Context& x = cell.context;
  detail::sortItems(common_, [&](const Common& a, const Common& b) {
    for (int d = 0; d < 3; ++d) {
      if (std::fabs(a.point[d] - b.point[d]) > 2 * margin_[d]) return a.point[d] < b.point[d];
      if (x.exact[a.vertex][size_t(d)] == x.exact[b.vertex][size_t(d)]) continue;
      return compare(x, spotAt(cell, a.vertex), spotAt(cell, b.vertex), d) < 0;
    }
    return false;
  });
}

/// Exact: whether a vertex lies in the plane of a face.
bool CrossingCheck::isIn(const GridCell& cell, uint32_t v, uint32_t f) const {
  return cell.context.inPlane(v, size_t(cell.context.cut.faceTriangle[cell.faces[f].id]));
}

/// Adds the vertices of a face that may lie in the plane of another one. Returns whether all may.
bool CrossingCheck::gatherNear(const GridCell& cell, uint32_t face, uint32_t other) {
  const Plane& plane = planes_[other];
  bool all = true;
  for (uint32_t i = cell.faces[face].firstCorner; i < cell.faces[face].lastCorner; ++i) {
    if (std::fabs(plane.height(cell.corners[i])) <= plane.doubt) {
      common_.push_back({cell.cornerVertex[i], cell.corners[i]});
    } else {
      all = false;
    }
  }
  return all;
}

/// Exact: whether the triangles of two faces lie in one plane.
bool CrossingCheck::haveOnePlane(const GridCell& cell, uint32_t f, uint32_t g) const {
  const Context& x = cell.context;
  return x.haveOnePlane(size_t(x.cut.faceTriangle[cell.faces[f].id]), size_t(x.cut.faceTriangle[cell.faces[g].id]));
}

}  // namespace mandoline::validation
