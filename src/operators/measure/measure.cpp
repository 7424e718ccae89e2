// Lengths, areas, volumes and centroids, accurate relative to the element's own size.
//
// A cut-vertex's rounded position is good to 1e-16 of the grid's coordinates, which is useless in a cell of width 1e-10. So vertices
// are made again from their provenance as double-doubles (places.h), and an element is measured in coordinates relative to one of its
// vertices. Sums there are plain doubles where their terms don't cancel, else
// double-doubles.
#include "mandoline/measure.h"

#include "base/large_array.h"
#include "mesh/run_call.h"
#include "operators/cut_input.h"
#include "operators/measure/measure_part.h"
#include "operators/measure/places.h"

namespace mandoline {
namespace {

using measuring::cross;
using measuring::DoubleDouble;
using measuring::forEach;
using measuring::largestAxis;
using measuring::length;
using measuring::Places;
using measuring::Vector;

/// Sums whose terms are together this much larger than the sum are done again in double-doubles.
constexpr double kCancellation = 32;

/// Area and first moments of a face's projection along an axis, relative to the face's first vertex.
template <class Number>
struct Projection {
  Number twiceArea = 0, moment[2] = {0, 0};  ///< moment: six times the integral of each coordinate
  double magnitude = 0;                      ///< sum of the absolute values of the terms of twiceArea

  bool cancels() const { return magnitude >= kCancellation * std::fabs(double(twiceArea)); }
};

/// One face: its normal, area, and centroid relative to its first vertex.
struct FaceShape {
  Vector<double> normal{}, centroid{};
  double area = 0;
};

class Measuring {
 public:
  Measuring(const CutMesh& cutMesh, const Places& places) : cutMesh_(cutMesh), places_(places) {}

  Measures run(detail::Monitor& monitor) {
    const size_t faces = cutMesh_.faceCount();
    detail::makeLarge(measures_.faceArea, faces);
    detail::makeLarge(measures_.faceNormal, 3 * faces);
    detail::makeLarge(measures_.faceCentroid, 3 * faces);
    monitor.beginStage("faces", 1);
    forEach(faces, monitor, [&](size_t f) { keep(f, shapeOf(f)); });
    detail::makeLarge(measures_.cellVolume, cutMesh_.cellCount());
    detail::makeLarge(measures_.cellCentroid, 3 * cutMesh_.cellCount());
    monitor.beginStage("cells", 2);
    forEach(cutMesh_.cellCount(), monitor, [&](size_t c) { measureCell(c); });
    for (size_t f = 0; f < faces; ++f) {
      for (size_t d = 0; d < 3; ++d) {
        double& centroid = measures_.faceCentroid[3 * f + d];
        centroid = double(places_[firstVertex(f)][d] + centroid);
      }
    }
    return std::move(measures_);
  }

 private:
  template <class F>
  void forEachEdge(size_t face, const F& f) const {
    for (const std::span<const uint32_t> loop : cutMesh_.loops(face)) {
      for (size_t i = 0; i < loop.size(); ++i) f(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
    }
  }

  template <class Number>
  Projection<Number> project(size_t face, int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vector<DoubleDouble>& origin = places_[firstVertex(face)];
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
      const Vector<double> d = places_.between(firstVertex(face), from);
      const double height = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
      lie &= std::fabs(height) <= 1e-9 * (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
    });
    return lie;
  }

  /// A vector along a face's normal: that of its triangle, unless rounding has moved vertices off its plane and left the face an area.
  Vector<DoubleDouble> normalOf(size_t face) const {
    if (cutMesh_.faceTriangle[face] < 0) {
      Vector<DoubleDouble> normal;
      normal[cutMesh_.faceAxis[face]] = 1;
      return normal;
    }
    const Vector<DoubleDouble> normal = places_.triangleNormal(size_t(cutMesh_.faceTriangle[face]));
    if (lieInPlane(face, unit(normal))) return normal;
    const Vector<DoubleDouble> area = vectorArea(face);
    const bool hasArea = area[0].high != 0 || area[1].high != 0 || area[2].high != 0;
    return hasArea ? area : normal;
  }

  static Vector<double> unit(const Vector<DoubleDouble>& v) {
    const Vector<double> rounded = {v[0].high, v[1].high, v[2].high};
    const double size = length(rounded);
    return size == 0 ? rounded : Vector<double>{rounded[0] / size, rounded[1] / size, rounded[2] / size};
  }

  uint32_t firstVertex(size_t face) const { return cutMesh_.loops(face)[0][0]; }

  /// The measures have the shapes while cells are measured: with centroids relative to the first vertex, as accurate as tiny faces need.
  void keep(size_t face, const FaceShape& shape) {
    measures_.faceArea[face] = shape.area;
    std::copy_n(shape.normal.data(), 3, &measures_.faceNormal[3 * face]);
    std::copy_n(shape.centroid.data(), 3, &measures_.faceCentroid[3 * face]);
  }
  FaceShape kept(size_t face) const {
    const double *normal = &measures_.faceNormal[3 * face], *centroid = &measures_.faceCentroid[3 * face];
    return {{normal[0], normal[1], normal[2]}, {centroid[0], centroid[1], centroid[2]}, measures_.faceArea[face]};
  }

  FaceShape shapeOf(size_t face) const {
    FaceShape shape;
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
    const FaceShape shape = kept(face);
    const Vector<double> d = places_.between(apex, firstVertex(face));
    const double x = shape.normal[0] * d[0], y = shape.normal[1] * d[1], z = shape.normal[2] * d[2];
    pyramids.magnitude += shape.area * (std::fabs(x) + std::fabs(y) + std::fabs(z));
    pyramids.add(sign * shape.area * (x + y + z),
                 {3 * (d[0] + shape.centroid[0]), 3 * (d[1] + shape.centroid[1]), 3 * (d[2] + shape.centroid[2])});
  }

  void addPyramid(size_t face, double sign, uint32_t apex, Pyramids<DoubleDouble>& pyramids) const {
    const int axis = largestAxis(kept(face).normal), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Projection<DoubleDouble> projection = project<DoubleDouble>(face, axis);
    if (projection.twiceArea.high == 0) return;
    const Vector<DoubleDouble> n = normalOf(face), d = places_.between<DoubleDouble>(apex, firstVertex(face));
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

  void measureCell(size_t cell) {
    const uint32_t apex = firstVertex(cutMesh_.halfFaces(cell)[0] / 2);
    const Pyramids<double> fast = pyramidsOf<double>(cell, apex);
    if (!fast.cancels()) {
      setVolume(cell, apex, fast);
    } else {
      setVolume(cell, apex, pyramidsOf<DoubleDouble>(cell, apex));
      keepCentroidInside(cell);
    }
  }

  /// Rounding of made vertices may leave nothing of the volume by which moments are divided: the centroid is kept in the box around the
  /// vertices.
  void keepCentroidInside(size_t cell) {
    for (size_t d = 0; d < 3; ++d) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const uint32_t h : cutMesh_.halfFaces(cell)) {
        for (const uint32_t v : cutMesh_.loops(h / 2)[0]) {
          low = std::min(low, double(places_[v][d]));
          high = std::max(high, double(places_[v][d]));
        }
      }
      double& centroid = measures_.cellCentroid[3 * cell + d];
      centroid = std::min(std::max(centroid, low), high);
    }
  }

  template <class Number>
  void setVolume(size_t cell, uint32_t apex, const Pyramids<Number>& pyramids) {
    measures_.cellVolume[cell] = double(pyramids.volume3) / 3;
    for (int d = 0; d < 3; ++d) {
      const double offset = double(pyramids.volume3) == 0 ? 0 : double(pyramids.moment12[d] / pyramids.volume3) / 4;
      measures_.cellCentroid[3 * cell + d] = double(places_[apex][d] + offset);
    }
  }

  const CutMesh& cutMesh_;
  const Places& places_;
  Measures measures_;
};

}  // namespace

Measures measuring::measureBy(const detail::NamedMesh& mesh, const CutMesh& cutMesh, const RunOptions& options) {
  return detail::runCall("measuring", [&] {
    detail::Monitor monitor(options, 3);
    monitor.beginStage("vertices", 0);
    const Places places(mesh, cutMesh, monitor);
    Measures measures = Measuring(cutMesh, places).run(monitor);
    measures.madeFrom = cutMesh.fingerprint;
    return measures;
  });
}

Measures measure(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options) {
  const operators::CutInput input(mesh, cutMesh);
  return measuring::measureBy(input.mesh(), cutMesh, options);
}

/// Places and normals: see Places.
detail::MeshPart measuring::partMeasuredBy(const CutMesh& cutMesh, const detail::NamedMesh& mesh) {
  std::vector<uint32_t> triangles, vertices;
  for (const int32_t t : cutMesh.faceTriangle) {
    if (t >= 0) triangles.push_back(uint32_t(t));
  }
  for (size_t v = 0; v < cutMesh.vertexCount(); ++v) {
    const int32_t a = cutMesh.vertexParents[2 * v], b = cutMesh.vertexParents[2 * v + 1];
    if (a < 0 || cutMesh.vertexTriVertex[v] >= 0) continue;
    if (b < 0) {
      triangles.push_back(uint32_t(a));
    } else {
      vertices.insert(vertices.end(), {uint32_t(a), uint32_t(b)});
    }
  }
  return takePart(mesh, std::move(triangles), std::move(vertices));
}

}  // namespace mandoline
