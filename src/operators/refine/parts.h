// The cuts of the parts of the grid in which there are blocks of one size.
#pragma once

#include "base/parallel.h"
#include "mandoline/measure.h"
#include "mandoline/refine.h"
#include "operators/coarsen/block_tree.h"

namespace mandoline::refining {

using operators::Block;

/// A box of blocks of one level, as a cut-mesh.
struct Part {
  int level = 0;
  Block first{};                  ///< its lowest block
  CutMesh own;                    ///< its cut-mesh, but for the grid's
  const CutMesh* grid = nullptr;  ///< that of the whole grid
  Measures measures;
  std::vector<int32_t> owners;      ///< per half-face: the cut-cell, or -1
  std::vector<uint32_t> triangles;  ///< per triangle that of the mesh; empty if it has all
  std::vector<uint32_t> triVertices;

  const CutMesh& cutMesh() const { return grid ? *grid : own; }
  uint32_t triangle(int32_t t) const { return grid ? uint32_t(t) : triangles[size_t(t)]; }
  uint32_t triVertex(int32_t v) const { return grid ? uint32_t(v) : triVertices[size_t(v)]; }
  /// The mesh's triangles that a face is a piece of.
  void appendParents(size_t face, std::vector<uint32_t>& to) const {
    const CutMesh& from = cutMesh();
    for (uint32_t i = from.faceParentOffsets[face]; i < from.faceParentOffsets[face + 1]; ++i)
      to.push_back(triangle(int32_t(from.faceParents[i])));
  }
  IdRange cellsAt(const Block& block) const { return cutMesh().cutCellsAt(block[0] - first[0], block[1] - first[1], block[2] - first[2]); }
};

/// The cut-cells of a block.
struct BlockCells {
  const Part* part = nullptr;
  size_t number = 0;  ///< of the part
  IdRange cells{0, 0};

  bool isCut() const { return cells.size() > 0; }
};

/// Calls visit(face, side of the face, cell) for those of a block's cells on one of its sides.
template <class Visit>
void forFacesOn(const BlockCells& cells, size_t axis, int side, const Visit& visit) {
  if (!cells.isCut()) return;
  const CutMesh& cutMesh = cells.part->cutMesh();
  const int32_t plane = cutMesh.cellGridCell[3 * cells.cells.begin + axis] + side;
  for (size_t c = cells.cells.begin; c < cells.cells.end; ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) {
      if (size_t(cutMesh.faceAxis[h / 2]) == axis && cutMesh.facePlane[h / 2] == plane) visit(h / 2, h % 2, int32_t(c));
    }
  }
}

class Parts {
 public:
  /// Cuts all parts with leaves, and with blocks beside those. `grids`: per level that of its blocks.
  Parts(const PreparedMesh& mesh, const CutMesh& cutMesh, const std::vector<Grid>& grids, const OctreeCells& leaves);
  void cut(detail::Monitor& monitor);

  size_t size() const { return parts_.size(); }
  /// In ascending order of levels.
  const Part& operator[](size_t part) const { return parts_[part]; }
  BlockCells at(int level, const Block& block) const;

 private:
  static constexpr int kShift = 4;  // 16 blocks along each side of a part
  static bool isInside(const Block& block);
  uint64_t keyOf(int level, const Block& block) const;
  std::vector<uint64_t> wantedAt(int level) const;

  const PreparedMesh& mesh_;
  const CutMesh& cutMesh_;
  const std::vector<Grid>& grids_;
  const OctreeCells& leaves_;
  std::vector<Part> parts_;
  std::vector<std::vector<std::pair<uint64_t, uint32_t>>> numbers_;  // per level: keys of parts, ascending, with their numbers
};

}  // namespace mandoline::refining
