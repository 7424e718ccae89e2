// Where the vertices of a cut-mesh are, more exactly than their rounded positions tell.
#pragma once

#include <vector>

#include "base/double_double.h"
#include "base/parallel.h"
#include "mandoline/cut_mesh.h"
#include "mesh/mesh_part.h"
#include "operators/measure/vector.h"

namespace mandoline::measuring {

using detail::DoubleDouble;

/// Coordinates of all vertices, as double-doubles made from their provenance: the tri-edge or triangle and the exact planes that they lie
/// on. `mesh` is that of CutInput, or a part of it.
class Places {
 public:
  Places(const detail::NamedMesh& mesh, const CutMesh& cutMesh, detail::Monitor& monitor);

  const Vector<DoubleDouble>& operator[](size_t v) const { return places_[v]; }

  /// b - a, rounded once per coordinate unless Number is DoubleDouble.
  template <class Number = double>
  Vector<Number> between(size_t a, size_t b) const {
    const Vector<DoubleDouble>&p = places_[a], &q = places_[b];
    return {Number(q[0] - p[0]), Number(q[1] - p[1]), Number(q[2] - p[2])};
  }

  /// Twice the vector area of a triangle of the mesh.
  Vector<DoubleDouble> triangleNormal(size_t t) const;

 private:
  bool onPlane(size_t v, int d) const { return (cutMesh_.vertexMask[v] >> d & 1) != 0; }
  double plane(size_t v, int d) const { return cutMesh_.grid.planes[size_t(d)][size_t(cutMesh_.vertexCell[3 * v + size_t(d)])]; }
  Vector<DoubleDouble> make(size_t v) const;
  void placeOnEdge(size_t v, const double* a, const double* b, Vector<DoubleDouble>& place) const;
  void placeInTriangle(size_t v, size_t triangle, Vector<DoubleDouble>& place) const;

  const detail::NamedMesh mesh_;
  const CutMesh& cutMesh_;
  std::vector<Vector<DoubleDouble>> places_;
};

/// f(i) for i in 0..n-1, on all threads.
template <class F>
void forEach(size_t n, detail::Monitor& monitor, const F& f) {
  struct Nothing {};
  detail::forChunks<Nothing>(n, monitor, [&](Nothing&, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) f(i);
  });
}

}  // namespace mandoline::measuring
