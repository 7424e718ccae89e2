// What one process has of the cell complex of a cut that several processes made together: see mandoline/distributed.h.
#pragma once

#include "mandoline/cell_complex.h"

namespace MANDOLINE_API mandoline {

/// The faces that cells of a process share with those of another one.
struct ComplexSeam {
  int rank;                     ///< the other process
  std::vector<uint32_t> faces;  ///< ascending: inner ones, and those of the surface. The other process has them in the same order
};

/// The cells of some layers of the grid along z: a process's own, and around them ghosts, which belong to others. All arrays of `cells` are
/// as in the cellComplex() of the whole, to the bit, and in its order. What is at the far side of the ghosts may lack vertices there, and
/// has no ids; faces there have one cell and the tag inner. Of octree cells, those are a process's own whose lowest grid cells lie in its
/// layers; ghosts that reach out of all layers may lack faces and vertices.
struct RankComplex {
  CutMesh cutMesh;                     ///< as RankPiece::cutMesh, of all these layers
  CellComplex cells;                   ///< made from it
  std::array<int64_t, 2> layers{};     ///< the process's own
  std::array<int64_t, 2> allLayers{};  ///< with those of the ghosts

  static constexpr uint64_t kNoId = ~uint64_t(0);
  // Ids in the cellComplex() of the whole; those that are there ascend.
  std::vector<uint64_t> vertexIds;  ///< per vertex, or kNoId
  std::vector<uint64_t> faceIds;    ///< per face, or kNoId
  std::vector<uint64_t> cellIds;    ///< per cell

  std::vector<int32_t> cellRanks;  ///< per cell: the process that it belongs to
  std::vector<ComplexSeam> seams;  ///< by rank
  uint64_t wholeVertices = 0;      ///< how many the whole has
  uint64_t wholeFaces = 0;         ///< the same of faces
  uint64_t wholeCutCells = 0;      ///< how many of the whole's cells are cut-cells, which come first
  uint64_t wholeCells = 0;         ///< how many the whole has
};

}  // namespace mandoline
