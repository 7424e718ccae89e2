// Mandoline: cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.
//
// After "Mandoline: Robust Cut-Cell Generation for Arbitrary Triangle Meshes" (Tao, Batty, Fiume, Levin; SIGGRAPH Asia 2019), with
// exact predicates in place of floating-point decisions. This header is the whole interface of the cutter; measure.h, triangulate.h,
// validate.h and io.h work on its results and see nothing else.
//
//   mandoline::Mesh mesh = mandoline::readMesh("bunny.obj");
//   mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 32));
//   if (!result) throw std::runtime_error(result.error.message);
//
// All arrays are flat, all ids count from 0, and every offsets array starts with 0 and has one more entry than there are items.
// Lengths are in world units unless "cells" is said.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mandoline {

/// A triangle mesh. The normal of triangle (a, b, c) is (b - a) x (c - a). It may be open, non-manifold, inconsistently oriented, unwelded.
struct Mesh {
  std::vector<double> positions;    ///< 3 per tri-vertex: x, y, z
  std::vector<uint32_t> triangles;  ///< 3 per triangle: tri-vertex ids

  size_t vertexCount() const { return positions.size() / 3; }
  size_t triangleCount() const { return triangles.size() / 3; }
};

/// A mesh somebody else owns, in the layout of Mesh.
struct MeshView {
  std::span<const double> positions;
  std::span<const uint32_t> triangles;

  MeshView(std::span<const double> positions_, std::span<const uint32_t> triangles_) : positions(positions_), triangles(triangles_) {}
  MeshView(const Mesh& mesh) : positions(mesh.positions), triangles(mesh.triangles) {}
  size_t vertexCount() const { return positions.size() / 3; }
  size_t triangleCount() const { return triangles.size() / 3; }
};

/// A rectilinear grid: per axis d the ascending coordinates of its cells[d] + 1 axial planes (paper, 3.1). These doubles are the grid:
/// every decision compares input doubles with them. Grid cell (i, j, k) spans planes[0][i] .. planes[0][i + 1] and so on.
struct Grid {
  std::array<std::vector<double>, 3> planes;
  bool uniform = false;  ///< whether origin and spacing describe it

  std::array<double, 3> origin{};   ///< its lowest corner
  std::array<double, 3> spacing{};  ///< size of a cell per axis; zero if not uniform

  /// The box from lo to hi in cells[d] cells per axis: plane c lies at lo + (hi - lo) * c / n.
  static Grid box(const std::array<double, 3>& lo, const std::array<double, 3>& hi, const std::array<int64_t, 3>& cells);
  /// Plane c lies at origin + spacing * c.
  static Grid regular(const std::array<double, 3>& origin, const std::array<double, 3>& spacing, const std::array<int64_t, 3>& cells);
  /// Any ascending planes, for graded grids.
  static Grid rectilinear(std::array<std::vector<double>, 3> planes);
  /// Cubic cells of size 1.1 x longest side of the bounding box / n, as many per axis as cover the box with that margin, centred.
  static Grid around(const MeshView& mesh, int64_t n);

  /// Number of grid cells along an axis (0 for a grid that could not be made, which cut() reports).
  int64_t cells(int axis) const { return planes[axis].empty() ? 0 : int64_t(planes[axis].size()) - 1; }
};

enum class Status : uint8_t {
  ok,
  cancelled,            ///< the progress callback returned false
  emptyMesh,            ///< no triangles
  badArrays,            ///< an array's length is not a multiple of 3
  badIndex,             ///< element: the triangle that names a tri-vertex that does not exist
  nonFiniteCoordinate,  ///< element: the tri-vertex
  badGrid,              ///< no cells on an axis, planes not ascending or not finite; element: the axis
  gridTooLarge,         ///< more than 2^24 cells on an axis (element), or more than 2^28 rows of cells
  badOption,            ///< snapTolerance outside of [0, 0.5)
  selfIntersection,     ///< element, element2: two triangles that meet other than in a shared vertex or edge
  meshTooLarge,         ///< more than 2^32 elements in the result
  outOfMemory,
  internalError,  ///< a fault of this library
};

/// The status as the word above, e.g. "selfIntersection".
const char* name(Status status);

struct Error {
  Status status = Status::ok;
  int64_t element = -1, element2 = -1;  ///< what they are depends on the status; -1 for none
  std::string message;                  ///< a full sentence that names the elements; empty if ok
};

/// How far a cut has come: `done` of `total` items of the stage, and the stage's place among all.
struct Progress {
  const char* stage;
  int stageIndex, stageCount;
  size_t done, total;
};

struct CutOptions {
  /// Tri-vertices within this distance of an axial plane (in cells, below 0.5) are moved onto it before cutting.
  double snapTolerance = 0;
  /// Threads to use; 0 for all cores. The result is the same to the bit for any number.
  unsigned threads = 1;
  /// Called now and then, never from two threads at once; false cancels the cut.
  std::function<bool(const Progress&)> progress;
};

/// The cut-mesh. Its arrays are those of the JSON dump and of the npm package, under the same names.
struct CutMesh {
  Grid grid;

  // Cut-vertices (paper, 3.2), in this order: tri-vertices, crossings of tri-edges, crossings of triangles with grid lines, grid vertices.
  std::vector<double> positions;         ///< 3 per vertex. Output only: no decision reads them
  std::vector<int32_t> vertexCell;       ///< 3 per vertex: the paper's c, exact. 0..n-1, or n on the last plane
  std::vector<uint8_t> vertexMask;       ///< per vertex: the paper's b. Bit d is set when it lies exactly on plane vertexCell[d] of axis d
  std::vector<int32_t> vertexTriVertex;  ///< per vertex: the tri-vertex (lowest id at its position), or -1
  std::vector<int32_t>
      vertexParents;  ///< 2 per vertex: tri-vertex (v, v); on a tri-edge its ends (a, b); in a triangle (t, -1); grid (-1, -1)

  // Cut-faces. The first loop of a face is its outer one, counter-clockwise about the face's normal; the others are holes, clockwise.
  std::vector<uint32_t> loopOffsets;      ///< into loopVertices
  std::vector<uint32_t> loopVertices;     ///< vertex ids
  std::vector<uint32_t> faceLoopOffsets;  ///< into loops: face f has loops faceLoopOffsets[f] .. faceLoopOffsets[f + 1] - 1
  std::vector<int32_t> faceTriangle;      ///< per face: input triangle (its normal is the face's), or -1 for a piece of a grid-face
  std::vector<int8_t> faceAxis;           ///< per face: 0..2 if it lies in an axial plane, else -1. A grid-face's normal is +axis
  std::vector<int32_t> facePlane;         ///< per face: index of that plane, else 0

  // Cut-cells, in ascending order of grid cells, x fastest. Half-face = 2 * face + side; side 0: the face's normal points out of the
  // cell, side 1: into it.
  std::vector<uint32_t> cellHalfFaceOffsets;  ///< into cellHalfFaces
  std::vector<uint32_t> cellHalfFaces;        ///< half-faces; the outer shell's and those of cavities and floating sheets
  std::vector<int32_t> cellGridCell;          ///< 3 per cut-cell: the grid cell it lies in
  std::vector<uint32_t> cellRegion;           ///< per cut-cell: region

  // Untouched grid cells, as runs along x. Row r = k * cells(1) + j has runs rowRunOffsets[r] .. rowRunOffsets[r + 1] - 1.
  std::vector<uint32_t> rowRunOffsets;  ///< into runs
  std::vector<int32_t> runBegin;        ///< per run: first grid cell along x
  std::vector<int32_t> runEnd;          ///< per run: one past the last
  std::vector<uint32_t> runRegion;      ///< per run: region

  // Regions: connected components of cut-cells and untouched grid cells, joined through faces that are not pieces of triangles.
  uint32_t regionCount = 0;
  bool hasWinding = false;             ///< whether the input is closed and consistently oriented, so that it has winding numbers
  std::vector<int32_t> regionWinding;  ///< per region: +1 inside of an outward oriented closed surface; empty unless hasWinding

  uint32_t triangleCount = 0;              ///< of the input
  std::vector<uint32_t> droppedTriangles;  ///< ascending ids of triangles without a face: zero area, duplicate, outside of the grid

  size_t vertexCount() const { return vertexMask.size(); }
  size_t loopCount() const { return loopOffsets.empty() ? 0 : loopOffsets.size() - 1; }
  size_t faceCount() const { return faceTriangle.size(); }
  size_t cellCount() const { return cellRegion.size(); }
  size_t untouchedCellCount() const;

  std::span<const uint32_t> loop(size_t l) const { return {loopVertices.data() + loopOffsets[l], loopOffsets[l + 1] - loopOffsets[l]}; }
  std::span<const uint32_t> cell(size_t c) const {
    return {cellHalfFaces.data() + cellHalfFaceOffsets[c], cellHalfFaceOffsets[c + 1] - cellHalfFaceOffsets[c]};
  }
  /// The dense form of the runs: region of each grid cell, x fastest; -1 where cut-cells replace it.
  std::vector<int32_t> gridCellRegion() const;
};

struct StageTime {
  const char* stage;
  double ms;
};

struct CutStats {
  std::vector<StageTime> stages;  ///< in order
  double totalMs = 0;
  uint64_t exactFallbacks = 0;  ///< signs that needed exact arithmetic
  uint32_t weldedVertices = 0;  ///< tri-vertices that share their position with a lower one
  uint32_t zeroAreaTriangles = 0, duplicateTriangles = 0, outsideTriangles = 0;  ///< dropped
  uint32_t snappedVertices = 0;                                                  ///< moved onto a plane by snapTolerance
  double largestSnap = 0;                                                        ///< farthest such move, in cells
  uint32_t flushedCoordinates = 0;                                               ///< below 2^-200 of the largest, taken as 0
};

struct CutResult {
  Error error;
  CutMesh mesh;  ///< empty unless ok
  CutStats stats;

  explicit operator bool() const { return error.status == Status::ok; }
};

/// Cuts the mesh with the grid (Algorithm 1 of the paper). Never throws: failures come back as a status with the offending elements.
CutResult cut(const MeshView& mesh, const Grid& grid, const CutOptions& options = {});

}  // namespace mandoline
