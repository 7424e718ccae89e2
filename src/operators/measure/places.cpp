#include "operators/measure/places.h"

#include "base/large_array.h"

namespace mandoline::measuring {

using detail::twoSum;

Places::Places(const detail::NamedMesh& mesh, const CutMesh& cutMesh, detail::Monitor& monitor) : mesh_(mesh), cutMesh_(cutMesh) {
  detail::makeLarge(places_, cutMesh.vertexCount());
  forEach(places_.size(), monitor, [&](size_t v) { places_[v] = make(v); });
}

Vector<DoubleDouble> Places::triangleNormal(size_t t) const {
  const double *a = mesh_.corner(t, 0), *b = mesh_.corner(t, 1), *c = mesh_.corner(t, 2);
  return cross<DoubleDouble>({twoSum(b[0], -a[0]), twoSum(b[1], -a[1]), twoSum(b[2], -a[2])},
                             {twoSum(c[0], -a[0]), twoSum(c[1], -a[1]), twoSum(c[2], -a[2])});
}

Vector<DoubleDouble> Places::make(size_t v) const {
  const int32_t p = cutMesh_.vertexParents[2 * v], q = cutMesh_.vertexParents[2 * v + 1];
  Vector<DoubleDouble> place;
  for (int d = 0; d < 3; ++d) place[d] = onPlane(v, d) ? plane(v, d) : cutMesh_.positions[3 * v + d];
  if (p < 0 || cutMesh_.vertexTriVertex[v] >= 0 || cutMesh_.vertexMask[v] == 7) return place;
  if (q < 0) {
    placeInTriangle(v, size_t(p), place);
  } else {
    placeOnEdge(v, mesh_.vertex(size_t(p)), mesh_.vertex(size_t(q)), place);
  }
  return place;
}

/// A crossing of the edge from a to b with the planes that the vertex lies on.
void Places::placeOnEdge(size_t v, const double* a, const double* b, Vector<DoubleDouble>& place) const {
  int across = -1;
  for (int d = 0; d < 3; ++d) {
    if (onPlane(v, d) && (across < 0 || std::fabs(b[d] - a[d]) > std::fabs(b[across] - a[across]))) across = d;
  }
  if (across < 0 || a[across] == b[across]) return;
  const DoubleDouble share = twoSum(plane(v, across), -a[across]) / twoSum(b[across], -a[across]);
  for (int d = 0; d < 3; ++d) {
    if (!onPlane(v, d)) place[d] = a[d] + share * twoSum(b[d], -a[d]);
  }
}

/// A crossing of a triangle's plane with a grid line.
void Places::placeInTriangle(size_t v, size_t triangle, Vector<DoubleDouble>& place) const {
  const int w = onPlane(v, 0) ? (onPlane(v, 1) ? 2 : 1) : 0, p = (w + 1) % 3, q = (w + 2) % 3;
  const double* a = mesh_.corner(triangle, 0);
  const Vector<DoubleDouble> normal = triangleNormal(triangle);
  if (normal[w].high == 0) return;
  const DoubleDouble slope = normal[p] * twoSum(plane(v, p), -a[p]) + normal[q] * twoSum(plane(v, q), -a[q]);
  place[w] = a[w] - slope / normal[w];
}

}  // namespace mandoline::measuring
