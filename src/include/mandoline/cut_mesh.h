// The cut-mesh: its arrays, the one description of them, and views.
//
// All arrays are flat, all ids count from 0, and every offsets array starts with 0 and has one more entry than there are items.
// Half-face = 2 * face + side; side 0: the face's normal points out of the cell, side 1: into it.
#pragma once

#include "mandoline/fields.h"
#include "mandoline/fingerprint.h"
#include "mandoline/grid.h"

namespace MANDOLINE_API mandoline {

/// The loops of a face, a range of spans of vertex ids: the outer one first, counter-clockwise about the face's normal, then holes,
/// clockwise.
class Loops {
 public:
  class Iterator {
   public:
    using difference_type = std::ptrdiff_t;
    using value_type = std::span<const uint32_t>;

    Iterator() = default;
    Iterator(const uint32_t* offset, const uint32_t* vertices) : offset_(offset), vertices_(vertices) {}
    std::span<const uint32_t> operator*() const { return {vertices_ + offset_[0], size_t(offset_[1] - offset_[0])}; }
    Iterator& operator++() {
      ++offset_;
      return *this;
    }
    Iterator operator++(int) { return {offset_++, vertices_}; }
    bool operator==(const Iterator& other) const { return offset_ == other.offset_; }

   private:
    const uint32_t *offset_ = nullptr, *vertices_ = nullptr;
  };

  /// `count` loops whose vertices are vertices[offsets[i]] .. vertices[offsets[i + 1] - 1].
  Loops(const uint32_t* offsets, size_t count, const uint32_t* vertices) : offsets_(offsets), count_(count), vertices_(vertices) {}
  size_t size() const { return count_; }
  std::span<const uint32_t> operator[](size_t i) const { return *Iterator(offsets_ + i, vertices_); }
  Iterator begin() const { return {offsets_, vertices_}; }
  Iterator end() const { return {offsets_ + count_, vertices_}; }

 private:
  const uint32_t* offsets_;
  size_t count_;
  const uint32_t* vertices_;
};

/// A cut-face, as a view.
struct Face {
  int32_t triangle;  ///< faceTriangle
  int32_t axis;      ///< faceAxis
  int32_t plane;     ///< facePlane
  Loops loops;
};

/// What meets at a made vertex, and so what its four parents are.
enum class MadeVertex : uint8_t {
  edgeTriangle,   ///< a tri-edge, by its two tri-vertices, and a triangle
  edgeEdge,       ///< two tri-edges, by their tri-vertices
  triangles,      ///< three triangles
  trianglesPlane  ///< two triangles, and an axial plane or several: see vertexMask
};

/// Ids begin .. end - 1.
struct IdRange {
  size_t begin, end;

  size_t size() const { return end - begin; }
};

/// What an array of a cut-mesh has an entry, or several, for.
enum class Element : uint8_t {
  vertex,
  loop,
  loopVertex,
  face,
  faceParent,
  madeVertex,
  cell,
  cellHalfFace,
  row,
  run,
  region,
  parityTriangle,
  openTriangle,
  droppedTriangle
};

/// One array of a cut-mesh.
struct ArrayInfo {
  const char* name;
  Element per;
  int items = 1;         ///< entries per element
  bool offsets = false;  ///< has one more entry than there are elements
};

/// The cut-mesh. The JSON dump has the same arrays under the same names, and the dense form of the runs, gridCellRegion, as one more;
/// of an array of regions that is not there, as regionWinding without winding numbers, it has a null per region.
struct CutMesh {
  Grid grid;

  // Cut-vertices (paper, 3.2), in this order: tri-vertices; vertices that triangles make by meeting; crossings of axial planes with
  // tri-edges and with the lines along which triangles meet; crossings of grid lines with triangles, and grid vertices, by grid cell.
  std::vector<double> positions;         ///< 3 per vertex, world units. Output only: no decision reads them
  std::vector<int32_t> vertexCell;       ///< 3 per vertex: the paper's c, exact. 0..n-1, or n on the last plane
  std::vector<uint8_t> vertexMask;       ///< per vertex: the paper's b. Bit d is set when it lies exactly on plane vertexCell[d] of axis d
  std::vector<int32_t> vertexTriVertex;  ///< per vertex: the tri-vertex (lowest id at its position), or -1
  std::vector<int32_t>
      vertexParents;  ///< 2 per vertex: tri-vertex (v, v); on a tri-edge its ends (a, b); in a triangle (t, -1); grid (-1, -1)

  // Made vertices: those that only exist because triangles meet other than in shared vertices and edges. Their vertexParents are (-1, -1).
  std::vector<uint32_t> madeVertices;      ///< ascending vertex ids
  std::vector<uint8_t> madeVertexKinds;    ///< per made vertex: MadeVertex
  std::vector<int32_t> madeVertexParents;  ///< 4 per made vertex, as its kind says; the rest is -1

  // Cut-faces: pieces of triangles, by grid cell and in each by triangle; then pieces of grid-faces, by grid cell. The first loop of a face
  // is its outer one, counter-clockwise about the face's normal; the others are holes, clockwise.
  std::vector<uint32_t> loopOffsets;        ///< into loopVertices, per loop
  std::vector<uint32_t> loopVertices;       ///< vertex ids
  std::vector<uint32_t> faceLoopOffsets;    ///< into loops: face f has loops faceLoopOffsets[f] .. faceLoopOffsets[f + 1] - 1
  std::vector<int32_t> faceTriangle;        ///< per face: its lowest triangle, whose normal it has; or -1 for a piece of a grid-face
  std::vector<uint32_t> faceParentOffsets;  ///< into faceParents, per face
  std::vector<uint32_t> faceParents;        ///< per face: all triangles that contain it, ascending: several where they lie on each other
  std::vector<int8_t> faceParentSigns;      ///< per parent: 1 if its normal is the face's, -1 if the opposite; their sum is the step of the
                                            ///< winding number from the front of the face to behind it
  std::vector<int8_t> faceAxis;             ///< per face: 0..2 if it lies in an axial plane, else -1. A grid-face's normal is +axis
  std::vector<int32_t> facePlane;           ///< per face: index of that plane, else 0

  // Cut-cells, in ascending order of grid cells, x fastest.
  std::vector<uint32_t> cellHalfFaceOffsets;  ///< into cellHalfFaces, per cut-cell
  std::vector<uint32_t> cellHalfFaces;        ///< half-faces: those of the outer shell, of cavities and of floating sheets
  std::vector<int32_t> cellGridCell;          ///< 3 per cut-cell: the grid cell it lies in
  std::vector<uint32_t> cellRegion;           ///< per cut-cell: region

  // Untouched grid cells, as runs along x. Row r = k * ny + j (ny: number of grid cells along y) has runs rowRunOffsets[r] ..
  // rowRunOffsets[r + 1] - 1.
  std::vector<uint32_t> rowRunOffsets;  ///< into the runs, per row
  std::vector<int32_t> runBegin;        ///< per run: first grid cell along x
  std::vector<int32_t> runEnd;          ///< per run: one past the last
  std::vector<uint32_t> runRegion;      ///< per run: region

  // Regions: connected components of cut-cells and untouched grid cells, joined through faces that are not pieces of triangles.
  uint32_t regionCount = 0;
  bool hasWinding = false;             ///< whether the input is closed and consistently oriented, so that it has winding numbers
  std::vector<int32_t> regionWinding;  ///< per region: 1 inside an outward oriented closed surface, 0 outside; empty unless hasWinding

  // What is known where the input has no winding numbers as a whole: see insideRegions(), which takes the best of it. The parts of
  // the input either have winding numbers, or parity alone (each edge has an even number of their triangles), or are open.
  std::vector<int32_t> regionPartWinding;  ///< per region: the sum over the parts that have winding numbers; empty if none has
  /// Per region: how many of the parts that have winding numbers or parity a path from outside crosses, modulo 2; empty if none has.
  std::vector<uint8_t> regionParity;
  /// Per region: an estimate of its winding number: regionPartWinding, and the generalized winding number of the open parts at a point
  /// of it; empty unless made by estimateInside(), which divides regions at grid-faces, too.
  std::vector<double> regionInsideness;
  std::vector<uint32_t> parityTriangles;  ///< ascending ids of triangles in parts that have parity alone
  std::vector<uint32_t> openTriangles;    ///< ascending ids of triangles in open parts

  uint32_t triangleCount = 0;              ///< of the input
  std::vector<uint32_t> droppedTriangles;  ///< ascending ids of triangles without a face: no area, or none inside the grid

  double snapTolerance = 0;  ///< that of the cut: functions that are given the input move its tri-vertices as the cut did
  Fingerprint madeFrom;      ///< of the input
  Fingerprint fingerprint;   ///< of the cut-mesh

  size_t vertexCount() const { return vertexMask.size(); }
  size_t loopCount() const { return loopOffsets.empty() ? 0 : loopOffsets.size() - 1; }
  size_t faceCount() const { return faceTriangle.size(); }
  size_t cellCount() const { return cellRegion.size(); }

  std::span<const uint32_t> loop(size_t l) const { return {loopVertices.data() + loopOffsets[l], loopOffsets[l + 1] - loopOffsets[l]}; }
  Loops loops(size_t f) const {
    return {loopOffsets.data() + faceLoopOffsets[f], size_t(faceLoopOffsets[f + 1] - faceLoopOffsets[f]), loopVertices.data()};
  }
  Face face(size_t f) const { return {faceTriangle[f], faceAxis[f], facePlane[f], loops(f)}; }
  std::span<const uint32_t> halfFaces(size_t cell) const {
    return {cellHalfFaces.data() + cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1] - cellHalfFaceOffsets[cell]};
  }
  /// The axial planes that two vertices both lie on: a bit per axis.
  uint8_t commonPlanes(size_t u, size_t v) const {
    uint8_t planes = vertexMask[u] & vertexMask[v];
    for (size_t d = 0; d < 3 && planes != 0; ++d) {
      if (vertexCell[3 * u + d] != vertexCell[3 * v + d]) planes &= uint8_t(~(1 << d));
    }
    return planes;
  }
  /// The cut-cells in a grid cell; none if it is untouched or lies outside the grid.
  IdRange cutCellsAt(int64_t i, int64_t j, int64_t k) const;
  /// The dense form of the runs: region of each grid cell, x fastest; -1 where cut-cells replace it. 4 bytes per grid cell: may throw
  /// bad_alloc.
  std::vector<int32_t> gridCellRegion() const;

  static void fields(auto& self, const auto& f) {
    f("grid", self.grid);
    f(ArrayInfo{"positions", Element::vertex, 3}, self.positions);
    f(ArrayInfo{"vertexCell", Element::vertex, 3}, self.vertexCell);
    f(ArrayInfo{"vertexMask", Element::vertex}, self.vertexMask);
    f(ArrayInfo{"vertexTriVertex", Element::vertex}, self.vertexTriVertex);
    f(ArrayInfo{"vertexParents", Element::vertex, 2}, self.vertexParents);
    f(ArrayInfo{"madeVertices", Element::madeVertex}, self.madeVertices);
    f(ArrayInfo{"madeVertexKinds", Element::madeVertex}, self.madeVertexKinds);
    f(ArrayInfo{"madeVertexParents", Element::madeVertex, 4}, self.madeVertexParents);
    f(ArrayInfo{"loopOffsets", Element::loop, 1, true}, self.loopOffsets);
    f(ArrayInfo{"loopVertices", Element::loopVertex}, self.loopVertices);
    f(ArrayInfo{"faceLoopOffsets", Element::face, 1, true}, self.faceLoopOffsets);
    f(ArrayInfo{"faceTriangle", Element::face}, self.faceTriangle);
    f(ArrayInfo{"faceParentOffsets", Element::face, 1, true}, self.faceParentOffsets);
    f(ArrayInfo{"faceParents", Element::faceParent}, self.faceParents);
    f(ArrayInfo{"faceParentSigns", Element::faceParent}, self.faceParentSigns);
    f(ArrayInfo{"faceAxis", Element::face}, self.faceAxis);
    f(ArrayInfo{"facePlane", Element::face}, self.facePlane);
    f(ArrayInfo{"cellHalfFaceOffsets", Element::cell, 1, true}, self.cellHalfFaceOffsets);
    f(ArrayInfo{"cellHalfFaces", Element::cellHalfFace}, self.cellHalfFaces);
    f(ArrayInfo{"cellGridCell", Element::cell, 3}, self.cellGridCell);
    f(ArrayInfo{"cellRegion", Element::cell}, self.cellRegion);
    f(ArrayInfo{"rowRunOffsets", Element::row, 1, true}, self.rowRunOffsets);
    f(ArrayInfo{"runBegin", Element::run}, self.runBegin);
    f(ArrayInfo{"runEnd", Element::run}, self.runEnd);
    f(ArrayInfo{"runRegion", Element::run}, self.runRegion);
    f("regionCount", self.regionCount);
    f(ArrayInfo{"regionWinding", Element::region}, Optional(self.regionWinding, &self.hasWinding));
    f(ArrayInfo{"regionPartWinding", Element::region}, Optional(self.regionPartWinding));
    f(ArrayInfo{"regionParity", Element::region}, Optional(self.regionParity));
    f(ArrayInfo{"regionInsideness", Element::region}, Optional(self.regionInsideness));
    f(ArrayInfo{"parityTriangles", Element::parityTriangle}, self.parityTriangles);
    f(ArrayInfo{"openTriangles", Element::openTriangle}, self.openTriangles);
    f("triangleCount", self.triangleCount);
    f(ArrayInfo{"droppedTriangles", Element::droppedTriangle}, self.droppedTriangles);
    f("snapTolerance", self.snapTolerance);
    f("madeFrom", self.madeFrom);
    f("fingerprint", self.fingerprint);
  }
};

/// The untouched grid cells of a cut-mesh, run by run.
class UntouchedCells {
 public:
  /// Grid cells (begin .. end - 1, j, k), all of one region.
  struct Run {
    int32_t begin, end, j, k;
    uint32_t region;

    int64_t count() const { return int64_t(end) - begin; }
  };

  explicit UntouchedCells(const CutMesh& cutMesh) : cutMesh_(cutMesh) {}

  /// Number of untouched grid cells.
  uint64_t count() const;
  /// The run that holds a grid cell, or -1 if it is cut or lies outside the grid.
  int64_t find(int64_t i, int64_t j, int64_t k) const;
  /// The region of a grid cell, or -1.
  int64_t regionAt(int64_t i, int64_t j, int64_t k) const {
    const int64_t run = find(i, j, k);
    return run < 0 ? -1 : int64_t(cutMesh_.runRegion[size_t(run)]);
  }
  /// f(run) for every run, by k, then j, then x.
  template <class F>
  void forEach(const F& f) const {
    const int64_t rows = int64_t(cutMesh_.rowRunOffsets.size()) - 1, ny = cutMesh_.grid.cells(1);
    for (int64_t row = 0; row < rows; ++row) {
      for (uint32_t r = cutMesh_.rowRunOffsets[size_t(row)]; r < cutMesh_.rowRunOffsets[size_t(row) + 1]; ++r) {
        f(Run{cutMesh_.runBegin[r], cutMesh_.runEnd[r], int32_t(row % ny), int32_t(row / ny), cutMesh_.runRegion[r]});
      }
    }
  }
  /// Volume of a run.
  double volume(const Run& run) const;
  /// Volume of all untouched grid cells.
  double volume() const;

 private:
  const CutMesh& cutMesh_;
};

/// How much a cut-mesh has.
struct CutCounts {
  uint64_t cutCells = 0, untouchedCells = 0, regions = 0, vertices = 0, faces = 0, loops = 0;
};
CutCounts countsOf(const CutMesh& cutMesh);

}  // namespace mandoline
