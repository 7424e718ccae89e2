#include "mesh/resolve/contact.h"

#include <algorithm>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// The place of a point in a triangle by the signs of its turns about the sides, 0 on a side; false if it lies outside.
bool placeBySigns(const std::array<int, 3>& signs, Place& place) {
  const auto [least, greatest] = std::minmax({signs[0], signs[1], signs[2]});
  if (least < 0 && greatest > 0) return false;
  const int zeros = int(std::count(signs.begin(), signs.end(), 0));
  place = Place();
  for (int i = 0; i < 3; ++i) {
    if (signs[size_t(i)] != 0) continue;
    if (zeros == 1) place = Place::side(i);
    if (zeros == 2 && signs[size_t(i + 1) % 3] == 0) place = Place::corner((i + 1) % 3);
  }
  return true;
}

}  // namespace

PointKey PointKey::edgeEdge(const Edge& e, const Edge& f) {
  const auto& [first, second] = std::minmax(e, f);
  return {Kind::edgeEdge, {first[0], first[1], second[0], second[1]}};
}

PointKey PointKey::ofTriangles(uint32_t r, uint32_t s, uint32_t t) {
  PointKey key{Kind::triangles, {r, s, t}};
  sortItems(std::span<uint32_t>(key.ids.data(), 3));
  return key;
}

int Contact::alongSide(int which) const {
  for (int side = 0; side < 3; ++side) {
    bool all = !hasArea();
    for (int i = 0; i < count; ++i) all &= corners[size_t(i)].places[size_t(which)].onSide(side);
    if (all) return side;
  }
  return -1;
}

bool ContactFinder::find(uint32_t s, uint32_t t, Contact& found) {
  ids_ = {s, t};
  corners_ = {mesh_.triangles[s], mesh_.triangles[t]};
  findShared();
  Side sides[2];
  if (!sidesOf(1, sides[1])) return false;
  contact_.coplanar = sides[1].signs[0] == 0 && sides[1].signs[1] == 0 && sides[1].signs[2] == 0;
  contact_.count = 0;
  if (contact_.coplanar) {
    addCoplanar();
  } else {
    if (!sidesOf(0, sides[0])) return false;
    addCrossings(0, sides[0]);
    addCrossings(1, sides[1]);
  }
  if (contact_.count <= sharedCount_) return false;
  found = contact_;
  return true;
}

void ContactFinder::findShared() {
  sharedCount_ = 0;
  shared_ = {{{-1, -1, -1}, {-1, -1, -1}}};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      if (corners_[0][i] != corners_[1][j]) continue;
      shared_[0][i] = int8_t(j);
      shared_[1][j] = int8_t(i);
      ++sharedCount_;
    }
  }
}

/// The sides of the other's plane that the corners of triangle `which` lie on; false if all but shared ones lie strictly on one side.
bool ContactFinder::sidesOf(int which, Side& side) {
  const Corners& other = corners_[size_t(1 - which)];
  bool above = false, below = false, on = false;
  for (size_t i = 0; i < 3; ++i) {
    side.signs[i] = 0;
    if (shared_[size_t(which)][i] >= 0) continue;
    side.signs[i] = orient(other[0], other[1], other[2], corners_[size_t(which)][i]);
    (side.signs[i] > 0 ? above : side.signs[i] < 0 ? below : on) = true;
  }
  return on || (above && below);
}

/// The points of the outline of triangle `which` that lie in the other, whose plane is another one.
void ContactFinder::addCrossings(int which, const Side& side) {
  const Corners &mine = corners_[size_t(which)], &other = corners_[size_t(1 - which)];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const uint32_t p = mine[size_t(i)], q = mine[size_t(j)];
    Place place;
    if (side.signs[i] == 0) {
      const int8_t shared = shared_[size_t(which)][size_t(i)];
      if (shared >= 0) {
        add(PointKey::vertex(p), which, Place::corner(i), Place::corner(shared));
      } else if (locate(other, p, place)) {
        add(PointKey::vertex(p), which, Place::corner(i), place);
      }
    }
    if (side.signs[i] * side.signs[j] < 0 && locateCrossing(p, q, other, place)) {
      add(keyOf(edgeOf(which, i), 1 - which, place), which, Place::side(i), place);
    }
  }
}

void ContactFinder::addCoplanar() {
  addCorners(0);
  addCorners(1);
  const int axis = axisAcross(corners_[0]);
  for (int i = 0; i < 3; ++i) {
    const uint32_t a = corners_[0][size_t(i)], b = corners_[0][size_t(i + 1) % 3];
    for (int j = 0; j < 3; ++j) {
      const uint32_t c = corners_[1][size_t(j)], d = corners_[1][size_t(j + 1) % 3];
      if (a == c || a == d || b == c || b == d) continue;
      if (orient(a, b, c, axis) * orient(a, b, d, axis) >= 0 || orient(c, d, a, axis) * orient(c, d, b, axis) >= 0) continue;
      add(PointKey::edgeEdge(edgeOf(0, i), edgeOf(1, j)), 0, Place::side(i), Place::side(j));
    }
  }
}

/// The corners of triangle `which` that lie in the other, whose plane is the same.
void ContactFinder::addCorners(int which) {
  for (int i = 0; i < 3; ++i) {
    const uint32_t v = corners_[size_t(which)][size_t(i)];
    const int8_t shared = shared_[size_t(which)][size_t(i)];
    Place place = Place::corner(shared);
    if (shared >= 0 || locate(corners_[size_t(1 - which)], v, place)) add(PointKey::vertex(v), which, Place::corner(i), place);
  }
}

/// Adds a corner of the contact; `mine` is its place in triangle `which`. The same point may come from both triangles.
void ContactFinder::add(const PointKey& key, int which, Place mine, Place others) {
  for (int i = 0; i < contact_.count; ++i) {
    if (contact_.corners[size_t(i)].key == key) return;
  }
  Contact::Corner& corner = contact_.corners[size_t(contact_.count++)];
  corner.key = key;
  corner.places[size_t(which)] = mine;
  corner.places[size_t(1 - which)] = others;
}

/// Where a tri-vertex in the plane of a triangle lies in it; false if outside.
bool ContactFinder::locate(const Corners& t, uint32_t v, Place& place) {
  const int axis = axisAcross(t);
  return placeBySigns({orient(t[0], t[1], v, axis), orient(t[1], t[2], v, axis), orient(t[2], t[0], v, axis)}, place);
}

/// Where a segment crosses the plane of a triangle, which it is known to do; false if outside the triangle.
bool ContactFinder::locateCrossing(uint32_t p, uint32_t q, const Corners& t, Place& place) {
  return placeBySigns({orient(p, q, t[0], t[1]), orient(p, q, t[1], t[2]), orient(p, q, t[2], t[0])}, place);
}

/// The point where an edge of one triangle meets the other at a place.
PointKey ContactFinder::keyOf(const PointKey::Edge& edge, int other, Place place) const {
  if (place.isCorner()) return PointKey::vertex(corners_[size_t(other)][size_t(place.index())]);
  if (place.isSide()) return PointKey::edgeEdge(edge, edgeOf(other, place.index()));
  return PointKey::edgeTriangle(edge, ids_[size_t(other)]);
}

int ContactFinder::orient(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const auto& points = mesh_.points;
  return predicates.orient3d(points[a].data(), points[b].data(), points[c].data(), points[d].data());
}

/// Which way a, b, c turn, seen along an axis.
int ContactFinder::orient(uint32_t a, uint32_t b, uint32_t c, int axis) {
  const size_t u = size_t(axis + 1) % 3, v = size_t(axis + 2) % 3;
  const Point &pa = mesh_.points[a], &pb = mesh_.points[b], &pc = mesh_.points[c];
  return predicates.orient2d({pa[u], pa[v]}, {pb[u], pb[v]}, {pc[u], pc[v]});
}

/// An axis that the triangle's plane is not parallel to, so that turns in the plane are those seen along it.
int ContactFinder::axisAcross(const Corners& t) {
  int axis = 0;
  while (axis < 2 && orient(t[0], t[1], t[2], axis) == 0) ++axis;
  return axis;
}

}  // namespace mandoline::detail
