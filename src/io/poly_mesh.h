// What the files of OpenFOAM's polyMesh have of a cell complex, in their order.
//
// A face's normal points out of its owner, the cell of lower number. Inner faces come first, by owner and then by neighbour (the upper
// triangular order), and those of each patch follow.
#pragma once

#include "base/function_ref.h"
#include "base/shared.h"
#include "io/complex_polygons.h"
#include "io/flat_polygons.h"
#include "mandoline/io.h"

namespace mandoline::detail {

/// One side of a face of the cell complex, whose cell is its owner.
struct PolySide {
  static constexpr int32_t kLeftOut = -1;

  int32_t owner, neighbour;  ///< cells of the polyMesh; no neighbour: kLeftOut
  uint32_t halfFace;
  bool isTurned = false;  ///< whether it has the first vertex that it has seen from the other side

  /// The i-th vertex of a polygon of the face.
  uint32_t vertex(std::span<const uint32_t> polygon, size_t i) const {
    const bool isForward = halfFace % 2 == 0;
    const size_t n = polygon.size(), first = isForward != isTurned ? 0 : n - 1;
    return polygon[(isForward ? first + i : first + n - i) % n];
  }
};

/// The upper triangular order of inner faces.
inline constexpr auto isUpperBefore = [](const auto& a, const auto& b) {
  return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
};

struct PolyPatch {
  std::string name;
  const char* type;
  std::vector<PolySide> sides;
  std::string entries = {};  ///< others than the type and what counts its faces
};

struct PolyZone {
  uint32_t region;
  std::vector<int32_t> cells;
};

/// All that is written.
struct PolyMesh {
  std::vector<int32_t> cellNumbers;    ///< per cell: that in the polyMesh, or PolySide::kLeftOut
  std::vector<uint32_t> pointNumbers;  ///< per vertex: that in the polyMesh, or kUnused
  std::vector<PolySide> inner;
  std::vector<PolyPatch> patches;
  std::vector<PolyZone> zones;  ///< by region
  uint64_t cells = 0, points = 0, faces = 0, innerFaces = 0;

  static constexpr uint32_t kUnused = ~0u;

  template <class Visit>
  void forEach(const Visit& visit) const {
    for (const PolySide& side : inner) visit(side);
    for (const PolyPatch& patch : patches) {
      for (const PolySide& side : patch.sides) visit(side);
    }
  }
};

/// The cells that isWritten(cell) holds for, their faces and zones. What is cut off is in the patch `inner`, which is there only where it
/// has faces. `groups` may be null; simpleCells as of WriteOptions.
MANDOLINE_SHARED PolyMesh makePolyMesh(const CutMesh& cutMesh, const CellComplex& cells, const TriangleGroups* groups, bool simpleCells,
                                       FunctionRef<bool(size_t cell)> isWritten);

inline bool isMerged(const CellComplex& cells) { return !cells.cellMemberOffsets.empty(); }

/// Per region 1 if a cell of it is at a side of the grid, else 0.
MANDOLINE_SHARED std::vector<uint8_t> regionsAtSides(uint32_t regionCount, const CellComplex& cells);

/// How many regions of merged cells are left out, of those at sides of the grid: the others, if there are both.
MANDOLINE_SHARED size_t countLeftOut(const std::vector<uint8_t>& atSides);

/// Drops the sides of faces that have no polygons, and the patch `inner` if it has no others.
MANDOLINE_SHARED void dropEmptySides(PolyMesh& mesh, const ComplexPolygons& polygons);

/// A list of numbers that is a file beside the others.
struct PolyList {
  const char* name;
  std::vector<int64_t> numbers;
};

struct PolyFiles {
  const CellComplex& cells;
  const ComplexPolygons& polygons;
  PolyMesh& mesh;
  std::vector<PolyList> lists = {};
  MovedVertices moved = {};
};
/// Which vertices the mesh has, and how many faces; then all sides have to be there.
MANDOLINE_SHARED void countFaces(PolyFiles& files);
MANDOLINE_SHARED void writeFiles(const FolderSink& sink, const PolyFiles& files, const RunOptions& options);
/// Calls write(sink) for the files of a folder, which is made if need be; they appear when all are complete. Throws FileError.
MANDOLINE_SHARED void writeFolder(const std::string& folder, FunctionRef<void(const FolderSink&)> write);

}  // namespace mandoline::detail
