// The vertices on grid lines in a cell complex: corners of cut grid cells and octree cells, and cut-vertices between them.
#pragma once

#include "operators/cell_complex/octree_index.h"

namespace mandoline::operators {

/// Keeps references to both.
class GridCorners {
 public:
  GridCorners(const CutMesh& cutMesh, const OctreeCells& octree);

  /// Those that are not cut-vertices: their ids follow those of the cut-vertices.
  const std::vector<GridIndex>& added() const { return added_; }

  /// Appends the loop of an octree cell's lower (0) or upper (1) side, counter-clockwise about +axis, with the vertices that other cells
  /// have on its edges.
  void appendSide(size_t cell, size_t axis, int side, std::vector<uint32_t>& ids) const;

 private:
  /// A piece of a grid line, 2^level cells long, or the part of that inside the grid.
  struct Edge {
    size_t axis;
    int level;
  };
  void linkCutVertices();
  uint64_t numberOf(const GridIndex& at) const;
  uint32_t idAt(const GridIndex& at) const;
  void appendEdge(const GridIndex& low, const Edge& edge, bool forwards, std::vector<uint32_t>& ids) const;
  void appendCutVertices(const GridIndex& low, size_t axis, std::vector<uint32_t>& ids) const;
  void appendInside(const GridIndex& low, const Edge& edge, std::vector<uint32_t>& ids) const;

  const CutMesh& cutMesh_;
  const OctreeCells& octree_;
  detail::RankedSet places_;   // of corners
  std::vector<uint32_t> ids_;  // by the ranks of their places
  std::vector<GridIndex> added_;
  std::vector<std::array<uint32_t, 2>> links_;  // cut-edges on grid lines that end inside of a grid-edge, both ways, ascending
};

}  // namespace mandoline::operators
