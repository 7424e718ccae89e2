// What one brick adds to the result: the stages from the tri-cut-faces to the cut-cells on its grid cells.
//
// In: SurfaceParts. Out: BrickCut, with numbers of its own, and the grid cells that the surface touches, marked in Bricks. Bricks are cut
// in any order, on any number of threads; none needs to know of another. What other processes cut has only what seams and regions need.
#pragma once

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
  bool isTri;
  std::array<int32_t, 2> steps;  ///< of a tri-cut-face, as those of a WindingStep
};

/// A grid-face on the boundary of the brick, by the cell of the brick that has it.
struct BoundaryFace {
  uint32_t cell;  ///< in the brick's box
  uint8_t index;  ///< in the cell
  Range triFaces, pieces, halves;
};

/// A grid-edge or grid vertex on the boundary of the brick, by its first cell there, with what is in its part of lineVertices.
struct BoundaryLine {
  uint32_t cell;
  uint8_t index;  ///< of a corner, or 8 + that of a grid-edge
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
  uint32_t place;  ///< in triOrder
  AxialPlane plane;
};

/// Its arrays are in the memory of BrickCuts.
struct BrickCut {
  CutVertices vertices;
  /// Those on grid lines that are not of the mesh or its edges, by the first cell that has them: at corners, then on grid-edges, there by
  /// triangle.
  std::span<const VertexId> lineVertices;

  // Tri-cut-faces, and how they are numbered in the result: by cell, inside of it before those in its grid-faces. Those in a grid-face
  // belong to the first cell of the brick that has it.
  CsrSpan<VertexId> triLoops;
  std::span<const uint32_t> triFaceLoopOffsets;  ///< empty if every face has one loop
  IdSpan<FaceId, TriangleId> triangles;
  std::span<const OtherParent> otherParents;
  std::span<const FaceId> triOrder;
  std::span<const InPlane> triFacesInPlane;  ///< ascending

  // Pieces of grid-faces, by the first cell of the brick that has them.
  CsrSpan<VertexId> loops;
  std::span<const uint32_t> faceLoopOffsets;
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
  std::span<const OpenFace> openFaces;
  std::span<const WindingStep> steps;  ///< between components
  std::optional<uint32_t>
      componentAtCorner;  ///< that of the point in windingBeside() at the grid's lowest corner, where the brick has that

  /// Calls f(array) for each that is in the memory of BrickCuts.
  template <class F>
  void forArrays(const F& f) {
    f(lineVertices);
    f(triLoops.offsets), f(triLoops.items), f(triFaceLoopOffsets), f(triangles), f(otherParents), f(triOrder), f(triFacesInPlane);
    f(loops.offsets), f(loops.items), f(faceLoopOffsets), f(pieces);
    f(halfFaces.offsets), f(halfFaces.items), f(gridCells), f(components);
    f(rows), f(boundaryFaces), f(boundaryHalves), f(boundaryLines), f(openFaces), f(steps);
  }

  bool isTri(FaceId face) const { return face.number < triangles.size(); }
  size_t faceCount() const { return triangles.size() + pieces.size(); }
  Groups<VertexId> loopsOf(FaceId face) const {
    const uint32_t triFaces = uint32_t(triangles.size()), piece = face.number - triFaces;
    if (face.number >= triFaces) return loops.groups(faceLoopOffsets[piece], faceLoopOffsets[piece + 1]);
    if (triFaceLoopOffsets.empty()) return triLoops.groups(face.number, face.number + 1);
    return triLoops.groups(triFaceLoopOffsets[face.number], triFaceLoopOffsets[face.number + 1]);
  }
};

/// Of all bricks, with the memory that holds it.
struct BrickCuts : IdVector<BrickId, BrickCut> {
  using IdVector::IdVector;

  std::vector<Arena> memory;
};

/// Bricks that need not be cut again: see kept_bricks.h.
struct KeptBricks {
  static constexpr BrickId kNone{~0u};
  static constexpr VertexId kNoVertex{~0u};

  BrickCuts cuts;                         ///< of all bricks; empty if none is kept
  IdVector<BrickId, BrickId> before;      ///< per brick: which it was; kNone if it is not kept. Empty if none is
  IdVector<VertexId, VertexId> vertices;  ///< per vertex of the surface before: which it is now; or kNoVertex

  bool has(BrickId brick) const { return !before.empty() && before[brick] != kNone; }
};

/// Cuts the bricks that are to be cut here, if they are not kept. Moves their cuts out of `kept`.
BrickCuts cutBricks(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, Run& run, KeptBricks& kept);

}  // namespace mandoline::detail
