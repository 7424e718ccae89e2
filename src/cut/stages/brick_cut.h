// What one brick adds to the result: the stages from the tri-cut-faces to the cut-cells on its grid cells.
//
// In: SurfaceParts. Out: BrickCut, with numbers of its own, and the grid cells that the surface touches, marked in Bricks. Bricks are cut
// in any order, on any number of threads; none needs to know of another. What other processes cut has only what seams and regions need.
#pragma once

#include <numeric>

#include "base/arena.h"
#include "cut/stages/cut_cells.h"
#include "cut/stages/winding_steps.h"

namespace mandoline::detail {

/// Ids first .. first + count - 1.
struct Range {
  uint32_t first = 0, count = 0;

  uint32_t past() const { return first + count; }
};

/// A row of grid cells along x, as far as it lies in the brick: where ends what its cells have first.
struct BrickRow {
  uint32_t row;  ///< k ny + j
  uint32_t pastCell, pastTriFace, pastPiece, pastVertex;
};

/// What lies in a grid-face, as the cell below sees it, and the component that the brick has beside it.
struct BoundaryHalf {
  HalfFace halfFace;
  uint32_t component;
  uint32_t isTri;                ///< or 0; there are no bytes between, since other processes are told all
  std::array<int32_t, 2> steps;  ///< of a tri-cut-face, as those of a WindingStep
};

/// A grid-face on the boundary of the brick, by the cell of the brick that has it.
struct BoundaryFace {
  uint32_t cell;   ///< in the brick's box
  uint32_t index;  ///< in the cell
  Range triFaces, pieces, halves;
};

/// A grid-edge or grid vertex on the boundary of the brick, by its first cell there, with what is in its part of lineVertices.
struct BoundaryLine {
  uint32_t cell;
  uint32_t index;  ///< of a corner, or 8 + that of a grid-edge
  Range vertices;
};

/// A grid-face between a cell of the brick and an untouched one in its box.
struct OpenFace {
  uint32_t cell;  ///< the untouched one
  uint32_t component;
};

struct AxialPlane {
  int32_t axis, plane;
};

struct InPlane {
  uint32_t face;  ///< of the brick
  AxialPlane plane;
};

/// The loops of some faces, which hold places of vertices.
struct FaceLoops {
  CsrSpan<uint32_t> loops;
  std::span<const uint32_t> offsets;  ///< per face its loops; empty if every face has one

  uint32_t firstLoop(uint32_t face) const { return offsets.empty() ? face : offsets[face]; }
  /// The number of loops of some faces, and of their vertices.
  uint32_t loopCount(uint32_t first, uint32_t past) const { return firstLoop(past) - firstLoop(first); }
  uint32_t vertexCount(uint32_t first, uint32_t past) const { return loops.offsets[firstLoop(past)] - loops.offsets[firstLoop(first)]; }
};

/// The memory that the arrays of bricks are in, by what the output has done with at the same time.
struct BrickMemory {
  Arena vertices, faces, cells, seams;

  size_t bytes() const { return vertices.bytes() + faces.bytes() + cells.bytes() + seams.bytes(); }
  void clear() {
    for (Arena* part : {&vertices, &faces, &cells, &seams}) part->clear();
  }
};

/// Its arrays are in the memory of BrickCuts.
struct BrickCut {
  uint32_t memory = 0;  ///< in which of them
  /// Those of the brick's own. Their places, in loops, are their numbers in the brick; then come those of surfaceVertices.
  CutVertices vertices;
  std::span<const VertexId> surfaceVertices;  ///< that loops have, in no order
  /// Those on grid lines that are not of the mesh or its edges, by the first cell that has them: at corners, then on grid-edges, there by
  /// triangle.
  std::span<const VertexId> lineVertices;

  // Tri-cut-faces, in the order of the result: by cell, inside of it before those in its grid-faces. Those in a grid-face belong to the
  // first cell of the brick that has it.
  FaceLoops triLoops;
  IdSpan<FaceId, TriangleId> triangles;
  std::span<const OtherParent> otherParents;
  std::span<const InPlane> triFacesInPlane;  ///< ascending

  // Pieces of grid-faces, which come after them, by the first cell of the brick that has them.
  FaceLoops pieceLoops;
  std::span<const AxialPlane> pieces;  ///< the planes that they lie in

  CsrSpan<HalfFace, CellId> halfFaces;
  IdSpan<CellId, uint32_t> gridCells;  ///< in the brick's box, ascending; elsewhere those of the components' first cells alone
  /// Joined through pieces of grid-faces inside of the brick; numbered by their first cells.
  IdSpan<CellId, uint32_t> components;
  uint32_t componentCount = 0;

  std::span<const BrickRow> rows;               ///< ascending, those with touched cells
  std::span<const BoundaryFace> boundaryFaces;  ///< ascending
  std::span<const BoundaryHalf> boundaryHalves;
  std::span<const BoundaryLine> boundaryLines;  ///< ascending
  std::span<const OpenFace> openFaces;          ///< only the first of those that follow each other along x beside the same run
  std::span<const WindingStep> steps;           ///< between components
  std::optional<uint32_t>
      componentAtCorner;  ///< that of the point in windingBeside() at the grid's lowest corner, where the brick has that

  /// Calls f(array, part of the memory) for each that is in the memory of BrickCuts.
  template <class F>
  void forArrays(const F& f) {
    const auto forEach = [&](Arena BrickMemory::*memory, auto&... arrays) { (f(arrays, memory), ...); };
    forEach(&BrickMemory::vertices, surfaceVertices, lineVertices, rows);
    forEach(&BrickMemory::faces, triangles, otherParents, triFacesInPlane, pieces);
    for (FaceLoops* loops : {&triLoops, &pieceLoops})
      forEach(&BrickMemory::faces, loops->loops.offsets, loops->loops.items, loops->offsets);
    forEach(&BrickMemory::cells, halfFaces.offsets, halfFaces.items, gridCells, components);
    forEach(&BrickMemory::seams, boundaryFaces, boundaryHalves, boundaryLines, openFaces, steps);
  }

  bool isTri(FaceId face) const { return face.number < triangles.size(); }
  size_t faceCount() const { return triangles.size() + pieces.size(); }
};

/// Of all bricks, with the memory that holds it.
struct BrickCuts : IdVector<BrickId, BrickCut> {
  using IdVector::IdVector;

  std::vector<BrickMemory> memory;
  std::vector<uint32_t> freeMemory;  ///< of these: empty, for bricks that are cut next

  size_t bytes() const {
    return std::accumulate(memory.begin(), memory.end(), size_t(0), [](size_t sum, const BrickMemory& of) { return sum + of.bytes(); });
  }
};

/// Bricks that need not be cut again: see kept_bricks.h.
struct KeptBricks {
  static constexpr BrickId kNone{~0u};
  static constexpr VertexId kNoVertex{~0u};

  BrickCuts cuts;                         ///< of all bricks; empty if none is kept
  IdVector<BrickId, BrickId> before;      ///< per brick: which it was; kNone if it is not kept. Empty if none is
  IdVector<BrickId, uint8_t> inner;       ///< per brick: whether it and all bricks around it are kept. Empty if none is
  IdVector<VertexId, VertexId> vertices;  ///< per vertex of the surface before: which it is now; or kNoVertex

  bool has(BrickId brick) const { return !before.empty() && before[brick] != kNone; }
  bool isInner(BrickId brick) const { return !inner.empty() && inner[brick]; }
};

/// Cuts the bricks that are to be cut here, if they are not kept. Moves their cuts out of `kept`, if there is one.
BrickCuts cutBricks(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, Run& run, KeptBricks* kept);

}  // namespace mandoline::detail
