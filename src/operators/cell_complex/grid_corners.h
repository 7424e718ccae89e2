// The vertices on grid lines in a cell complex: corners of cut grid cells and octree cells, and cut-vertices between them.
#pragma once

#include "base/csr.h"
#include "operators/cell_complex/octree_index.h"

namespace mandoline::operators {

/// Keeps references to both.
class GridCorners {
 public:
  GridCorners(const CutMesh& cutMesh, const OctreeCells& octree);

  // To be called before the rest, in any order or at once.
  void setPlaces();
  void linkCutVertices();

  /// Appends the positions of those that are not cut-vertices, whose ids follow those of the cut-vertices.
  void appendPositions(std::vector<double>& positions) const;

  /// Those of an octree cell. Bit d of their places tells the lower end along axis d (0) from the upper one (1).
  using OfCell = std::array<uint32_t, 8>;
  OfCell ofCell(size_t cell) const;

  /// Whether the sides of an octree cell have no other vertices than its corners.
  bool hasPlainSides(size_t cell, const OfCell& corners) const;

  /// The corners of an octree cell's lower (0) or upper (1) side, counter-clockwise about +axis.
  static std::array<uint32_t, 4> ofSide(const OfCell& corners, size_t axis, int side) {
    const size_t low = size_t(side) << axis, u = size_t(1) << (axis + 1) % 3, v = size_t(1) << (axis + 2) % 3;
    return {corners[low], corners[low | u], corners[low | u | v], corners[low | v]};
  }

  /// Appends the loop of an octree cell's lower (0) or upper (1) side, counter-clockwise about +axis, with the vertices that other cells
  /// have on its edges.
  void appendSide(size_t cell, const OfCell& corners, size_t axis, int side, std::vector<uint32_t>& ids) const;

 private:
  /// A piece of a grid line, 2^level cells long, or the part of that inside the grid.
  struct Edge {
    GridIndex low;
    uint32_t lowId;  ///< of the vertex there
    size_t axis;
    int level;
  };
  uint64_t numberOf(const GridIndex& at) const;
  uint32_t idAt(const GridIndex& at) const { return ids_[places_.rankOf(numberOf(at))]; }
  Edge edgeOf(size_t cell, const OfCell& corners, size_t axis, size_t corner) const;
  void appendInside(const Edge& edge, bool forwards, std::vector<uint32_t>& ids) const;
  void appendInside(const Edge& edge, std::vector<uint32_t>& ids) const;
  void appendCutVertices(const Edge& edge, std::vector<uint32_t>& ids) const;

  const CutMesh& cutMesh_;
  const OctreeCells& octree_;
  detail::RankedSet places_;     // of corners
  std::vector<uint32_t> ids_;    // by the ranks of their places
  size_t added_ = 0;             // how many are not cut-vertices
  detail::Csr<uint32_t> links_;  // per cut-vertex: the other ends of cut-edges on grid lines, if one end is inside of a grid-edge
};

}  // namespace mandoline::operators
