// Lengths, areas, volumes and centroids, accurate relative to the element's own size.
//
// A cut-vertex's rounded position is good to 1e-16 of the grid's coordinates, which is nothing beside a cell of width 1e-10. So vertices
// are made again from their provenance (the tri-edge or triangle and the exact planes that they lie on) as double-doubles, and an element
// is measured in coordinates relative to one of its vertices. Sums there are plain doubles where their terms don't cancel, else
// double-doubles.
#include "mandoline/measure.h"

#include <algorithm>
#include <cmath>

#include "base/double_double.h"

namespace mandoline {
namespace {

using detail::DoubleDouble;
using detail::twoSum;

/// Sums whose terms are together this much larger than the sum are done again in double-doubles.
constexpr double kCancellation = 32;

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector<double>& v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  if (largest == 0) return 0;
  const double x = v[0] / largest, y = v[1] / largest, z = v[2] / largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

int largestAxis(const Vector<double>& v) {
  int axis = 0;
  for (int d = 1; d < 3; ++d) {
    if (std::fabs(v[d]) > std::fabs(v[axis])) axis = d;
  }
  return axis;
}

/// Coordinates of all vertices, as double-doubles made from their provenance.
class Places {
 public:
  Places(const MeshView& mesh, const CutMesh& cutMesh) : mesh_(mesh), cutMesh_(cutMesh), vertexOf_(mesh.vertexCount(), -1) {
    const size_t n = cutMesh.vertexCount();
    for (size_t v = 0; v < n; ++v) {
      if (cutMesh.vertexTriVertex[v] >= 0) vertexOf_[cutMesh.vertexTriVertex[v]] = int32_t(v);
    }
    places_.resize(n);
    for (size_t v = 0; v < n; ++v) places_[v] = checked(v, make(v));
  }

  const Vector<DoubleDouble>& operator[](size_t v) const { return places_[v]; }

  /// b - a, rounded once per coordinate unless Number is DoubleDouble.
  template <class Number = double>
  Vector<Number> between(size_t a, size_t b) const {
    const Vector<DoubleDouble>&p = places_[a], &q = places_[b];
    return {Number(q[0] - p[0]), Number(q[1] - p[1]), Number(q[2] - p[2])};
  }

  /// Twice the vector area of a triangle of the mesh.
  Vector<DoubleDouble> triangleNormal(size_t t) const {
    const double *a = corner(t, 0), *b = corner(t, 1), *c = corner(t, 2);
    return cross<DoubleDouble>({twoSum(b[0], -a[0]), twoSum(b[1], -a[1]), twoSum(b[2], -a[2])},
                               {twoSum(c[0], -a[0]), twoSum(c[1], -a[1]), twoSum(c[2], -a[2])});
  }

 private:
  /// Where the cutter had a tri-vertex: the cut-mesh knows if it has been moved onto a plane.
  const double* triVertex(size_t v) const {
    return vertexOf_[v] < 0 ? &mesh_.positions[3 * v] : &cutMesh_.positions[3 * size_t(vertexOf_[v])];
  }
  const double* corner(size_t t, int i) const { return triVertex(mesh_.triangles[3 * t + i]); }

  Vector<DoubleDouble> make(size_t v) const {
    const int32_t p = cutMesh_.vertexParents[2 * v], q = cutMesh_.vertexParents[2 * v + 1];
    Vector<DoubleDouble> place;
    for (int d = 0; d < 3; ++d) place[d] = onPlane(v, d) ? plane(v, d) : cutMesh_.positions[3 * v + d];
    if (p < 0 || cutMesh_.vertexTriVertex[v] >= 0 || cutMesh_.vertexMask[v] == 7) return place;
    if (q < 0) {
      placeInTriangle(v, size_t(p), place);
    } else {
      placeOnEdge(v, triVertex(size_t(p)), triVertex(size_t(q)), place);
    }
    return place;
  }

  bool onPlane(size_t v, int d) const { return (cutMesh_.vertexMask[v] >> d & 1) != 0; }
  double plane(size_t v, int d) const { return cutMesh_.grid.planes[d][cutMesh_.vertexCell[3 * v + d]]; }

  /// A crossing of the edge from a to b with the planes that the vertex lies on.
  void placeOnEdge(size_t v, const double* a, const double* b, Vector<DoubleDouble>& place) const {
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
  void placeInTriangle(size_t v, size_t triangle, Vector<DoubleDouble>& place) const {
    const int w = onPlane(v, 0) ? (onPlane(v, 1) ? 2 : 1) : 0, p = (w + 1) % 3, q = (w + 2) % 3;
    const double* a = corner(triangle, 0);
    const Vector<DoubleDouble> normal = triangleNormal(triangle);
    if (normal[w].high == 0) return;
    const DoubleDouble slope = normal[p] * twoSum(plane(v, p), -a[p]) + normal[q] * twoSum(plane(v, q), -a[q]);
    place[w] = a[w] - slope / normal[w];
  }

  /// The place, unless it is off the vertex's position by more than rounding: tri-vertices that snapping moves but that are no vertices of
  /// the cut-mesh (outside of the grid, or welded by the move) have left no trace, and what is made from their old coordinates is wrong.
  Vector<DoubleDouble> checked(size_t v, const Vector<DoubleDouble>& place) const {
    for (int d = 0; d < 3; ++d) {
      const double position = cutMesh_.positions[3 * v + d];
      const auto& planes = cutMesh_.grid.planes[d];
      const size_t c = std::min<size_t>(size_t(cutMesh_.vertexCell[3 * v + d]), planes.size() - 2);
      if (!(std::fabs(place[d].high - position) <= 0x1p-40 * (planes[c + 1] - planes[c]) + 0x1p-48 * std::fabs(position))) {
        return {cutMesh_.positions[3 * v], cutMesh_.positions[3 * v + 1], cutMesh_.positions[3 * v + 2]};
      }
    }
    return place;
  }

  const MeshView& mesh_;
  const CutMesh& cutMesh_;
  std::vector<int32_t> vertexOf_;  // per tri-vertex
  std::vector<Vector<DoubleDouble>> places_;
};

/// Area and first moments of a face's projection along an axis, relative to the face's first vertex.
template <class Number>
struct Projection {
  Number twiceArea = 0, moment[2] = {0, 0};  ///< moment: six times the integral of each coordinate
  double magnitude = 0;                      ///< sum of the absolute values of the terms of twiceArea

  bool cancels() const { return magnitude >= kCancellation * std::fabs(double(twiceArea)); }
};

/// One face: its normal, and what its area and centroid are relative to its first vertex.
struct FaceShape {
  uint32_t first = 0;
  Vector<double> normal{}, centroid{};
  double area = 0;
};

class Measuring {
 public:
  Measuring(const MeshView& mesh, const CutMesh& cutMesh) : cutMesh_(cutMesh), places_(mesh, cutMesh) {}

  Measures run() {
    Measures measures;
    shapes_.resize(cutMesh_.faceCount());
    measures.faceArea.resize(shapes_.size());
    measures.faceNormal.resize(3 * shapes_.size());
    measures.faceCentroid.resize(3 * shapes_.size());
    for (size_t f = 0; f < shapes_.size(); ++f) {
      shapes_[f] = shapeOf(f);
      measures.faceArea[f] = shapes_[f].area;
      std::copy_n(shapes_[f].normal.data(), 3, &measures.faceNormal[3 * f]);
      for (int d = 0; d < 3; ++d) measures.faceCentroid[3 * f + d] = double(places_[shapes_[f].first][d] + shapes_[f].centroid[d]);
    }
    measures.cellVolume.resize(cutMesh_.cellCount());
    measures.cellCentroid.resize(3 * cutMesh_.cellCount());
    for (size_t c = 0; c < cutMesh_.cellCount(); ++c) measureCell(c, measures);
    return measures;
  }

 private:
  template <class F>
  void forEachEdge(size_t face, const F& f) const {
    for (uint32_t l = cutMesh_.faceLoopOffsets[face]; l < cutMesh_.faceLoopOffsets[face + 1]; ++l) {
      const auto loop = cutMesh_.loop(l);
      for (size_t i = 0; i < loop.size(); ++i) f(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
    }
  }

  template <class Number>
  Projection<Number> project(size_t face, int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vector<DoubleDouble>& origin = places_[shapes_[face].first];
    Projection<Number> result;
    forEachEdge(face, [&](uint32_t from, uint32_t to) {
      const Vector<DoubleDouble>&a = places_[from], &b = places_[to];
      const Number au = Number(a[u] - origin[u]), av = Number(a[v] - origin[v]), bu = Number(b[u] - origin[u]),
                   bv = Number(b[v] - origin[v]);
      const Number left = au * bv, right = av * bu, term = left - right;
      result.twiceArea += term;
      result.moment[0] += term * (au + bu);
      result.moment[1] += term * (av + bv);
      result.magnitude += std::fabs(double(left)) + std::fabs(double(right));
    });
    return result;
  }

  /// Twice the vector area of a face.
  Vector<DoubleDouble> vectorArea(size_t face) const {
    return {project<DoubleDouble>(face, 0).twiceArea, project<DoubleDouble>(face, 1).twiceArea, project<DoubleDouble>(face, 2).twiceArea};
  }

  /// Whether all vertices of a face lie in the plane through its first with that unit normal.
  bool lieInPlane(size_t face, const Vector<double>& normal) const {
    bool lie = true;
    forEachEdge(face, [&](uint32_t from, uint32_t) {
      const Vector<double> d = places_.between(shapes_[face].first, from);
      const double height = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
      lie &= std::fabs(height) <= 1e-9 * (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
    });
    return lie;
  }

  /// A vector along a face's normal: that of its triangle, unless the triangle's corners were moved without trace (see Places::checked).
  Vector<DoubleDouble> normalOf(size_t face) const {
    if (cutMesh_.faceTriangle[face] < 0) {
      Vector<DoubleDouble> normal;
      normal[cutMesh_.faceAxis[face]] = 1;
      return normal;
    }
    const Vector<DoubleDouble> normal = places_.triangleNormal(size_t(cutMesh_.faceTriangle[face]));
    return lieInPlane(face, unit(normal)) ? normal : vectorArea(face);
  }

  static Vector<double> unit(const Vector<DoubleDouble>& v) {
    const Vector<double> rounded = {v[0].high, v[1].high, v[2].high};
    const double size = length(rounded);
    return size == 0 ? rounded : Vector<double>{rounded[0] / size, rounded[1] / size, rounded[2] / size};
  }

  FaceShape shapeOf(size_t face) {
    FaceShape& shape = shapes_[face];
    shape.first = cutMesh_.loopVertices[cutMesh_.loopOffsets[cutMesh_.faceLoopOffsets[face]]];
    shape.normal = unit(normalOf(face));
    const int axis = largestAxis(shape.normal);
    if (shape.normal[axis] == 0) return shape;
    const Projection<double> fast = project<double>(face, axis);
    if (!fast.cancels()) {
      setArea(fast.twiceArea, fast.moment[0] / fast.twiceArea, fast.moment[1] / fast.twiceArea, axis, shape);
      return shape;
    }
    const Projection<DoubleDouble> slow = project<DoubleDouble>(face, axis);
    if (slow.twiceArea.high == 0) return shape;
    setArea(slow.twiceArea.high, double(slow.moment[0] / slow.twiceArea), double(slow.moment[1] / slow.twiceArea), axis, shape);
    return shape;
  }

  static void setArea(double twiceArea, double threeU, double threeV, int axis, FaceShape& shape) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vector<double>& n = shape.normal;
    shape.area = twiceArea / (2 * n[axis]);
    shape.centroid[u] = threeU / 3;
    shape.centroid[v] = threeV / 3;
    shape.centroid[axis] = -(n[u] * shape.centroid[u] + n[v] * shape.centroid[v]) / n[axis];
  }

  /// The divergence theorem, from a point of a cell: pyramids over its faces.
  template <class Number>
  struct Pyramids {
    Number volume3 = 0;         ///< three times the volume
    Vector<Number> moment12{};  ///< twelve times the integral of the place relative to the apex
    double magnitude = 0;       ///< sum of the absolute values of the terms of volume3

    bool cancels() const { return magnitude >= kCancellation * std::fabs(double(volume3)); }
    void add(const Number& term, const Vector<Number>& centroid3) {
      volume3 += term;
      for (int d = 0; d < 3; ++d) moment12[d] += term * centroid3[d];
    }
  };

  void addPyramid(size_t face, double sign, uint32_t apex, Pyramids<double>& pyramids) const {
    const FaceShape& shape = shapes_[face];
    const Vector<double> d = places_.between(apex, shape.first);
    const double x = shape.normal[0] * d[0], y = shape.normal[1] * d[1], z = shape.normal[2] * d[2];
    pyramids.magnitude += shape.area * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    pyramids.add(sign * shape.area * (x + y + z),
                 {3 * (d[0] + shape.centroid[0]), 3 * (d[1] + shape.centroid[1]), 3 * (d[2] + shape.centroid[2])});
  }

  void addPyramid(size_t face, double sign, uint32_t apex, Pyramids<DoubleDouble>& pyramids) const {
    const int axis = largestAxis(shapes_[face].normal), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Projection<DoubleDouble> projection = project<DoubleDouble>(face, axis);
    if (projection.twiceArea.high == 0) return;
    const Vector<DoubleDouble> n = normalOf(face), d = places_.between<DoubleDouble>(apex, shapes_[face].first);
    Vector<DoubleDouble> centroid3;
    centroid3[u] = projection.moment[0] / projection.twiceArea;
    centroid3[v] = projection.moment[1] / projection.twiceArea;
    centroid3[axis] = -((n[u] * centroid3[u] + n[v] * centroid3[v]) / n[axis]);
    for (int i = 0; i < 3; ++i) centroid3[i] += d[i] * 3.0;
    const DoubleDouble height = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / n[axis];
    pyramids.add(height * projection.twiceArea * (0.5 * sign), centroid3);
  }

  template <class Number>
  Pyramids<Number> pyramidsOf(size_t cell, uint32_t apex) const {
    Pyramids<Number> pyramids;
    for (const uint32_t h : cutMesh_.halfFaces(cell)) addPyramid(h / 2, h % 2 == 0 ? 1 : -1, apex, pyramids);
    return pyramids;
  }

  void measureCell(size_t cell, Measures& measures) const {
    const uint32_t apex = shapes_[cutMesh_.halfFaces(cell)[0] / 2].first;
    const Pyramids<double> fast = pyramidsOf<double>(cell, apex);
    if (!fast.cancels()) {
      setVolume(cell, apex, fast, measures);
    } else {
      setVolume(cell, apex, pyramidsOf<DoubleDouble>(cell, apex), measures);
    }
  }

  template <class Number>
  void setVolume(size_t cell, uint32_t apex, const Pyramids<Number>& pyramids, Measures& measures) const {
    measures.cellVolume[cell] = double(pyramids.volume3) / 3;
    for (int d = 0; d < 3; ++d) {
      const double offset = double(pyramids.volume3) == 0 ? 0 : double(pyramids.moment12[d] / pyramids.volume3) / 4;
      measures.cellCentroid[3 * cell + d] = double(places_[apex][d] + offset);
    }
  }

  const CutMesh& cutMesh_;
  Places places_;
  std::vector<FaceShape> shapes_;
};

}  // namespace

Measures measure(const MeshView& mesh, const CutMesh& cutMesh) { return Measuring(mesh, cutMesh).run(); }

CutEdges cutEdges(const MeshView& mesh, const CutMesh& cutMesh) {
  const auto forEachEdge = [&](const auto& f) {
    for (size_t l = 0; l < cutMesh.loopCount(); ++l) {
      const auto loop = cutMesh.loop(l);
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
        f(std::min(a, b), std::max(a, b));
      }
    }
  };
  std::vector<uint32_t> offsets(cutMesh.vertexCount() + 1, 0);
  forEachEdge([&](uint32_t low, uint32_t) { ++offsets[low + 1]; });
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) offsets[v + 1] += offsets[v];
  std::vector<uint32_t> highs(offsets.back()), at(offsets.begin(), offsets.end() - 1);
  forEachEdge([&](uint32_t low, uint32_t high) { highs[at[low]++] = high; });

  CutEdges edges;
  edges.edgeVertices.reserve(highs.size());
  edges.edgeLength.reserve(highs.size() / 2);
  const Places places(mesh, cutMesh);
  for (uint32_t low = 0; low < cutMesh.vertexCount(); ++low) {
    const auto begin = highs.begin() + offsets[low], end = highs.begin() + offsets[low + 1];
    std::sort(begin, end);
    const auto uniqueEnd = std::unique(begin, end);
    for (auto high = begin; high != uniqueEnd; ++high) {
      edges.edgeVertices.insert(edges.edgeVertices.end(), {low, *high});
      edges.edgeLength.push_back(length(places.between(low, *high)));
    }
  }
  return edges;
}

std::vector<double> regionVolumes(const CutMesh& cutMesh, const Measures& measures) {
  std::vector<DoubleDouble> sums(cutMesh.regionCount);
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) sums[cutMesh.cellRegion[c]] += measures.cellVolume[c];
  const auto& planes = cutMesh.grid.planes;
  const auto extent = [&](int d, size_t begin, size_t end) { return twoSum(planes[d][end], -planes[d][begin]); };
  const size_t ny = size_t(cutMesh.grid.cells(1));
  for (size_t row = 0; row + 1 < cutMesh.rowRunOffsets.size(); ++row) {
    if (cutMesh.rowRunOffsets[row] == cutMesh.rowRunOffsets[row + 1]) continue;
    const DoubleDouble section = extent(1, row % ny, row % ny + 1) * extent(2, row / ny, row / ny + 1);
    for (uint32_t r = cutMesh.rowRunOffsets[row]; r < cutMesh.rowRunOffsets[row + 1]; ++r) {
      sums[cutMesh.runRegion[r]] += section * extent(0, size_t(cutMesh.runBegin[r]), size_t(cutMesh.runEnd[r]));
    }
  }
  std::vector<double> volumes(sums.size());
  for (size_t r = 0; r < sums.size(); ++r) volumes[r] = double(sums[r]);
  return volumes;
}

}  // namespace mandoline
