// The corners and sides of untouched grid cells, shared with the cut-cells beside them.
#pragma once

#include "mandoline/mandoline.h"

namespace mandoline::detail {

/// Numbers the vertices of cut-cells and of untouched grid cells together: first the cut-vertices, then further grid vertices in order
/// of use. Knows which cut-vertices lie inside of a grid-edge, so that cells that only touch that edge can have them too.
class GridVertices {
 public:
  using Index = std::array<int32_t, 3>;

  explicit GridVertices(const CutMesh& cutMesh);

  /// The vertex at the crossing of three axial planes.
  uint32_t corner(const Index& at);
  /// Whether cut-vertices lie inside of the grid-edge that goes up the axis from a corner.
  bool divided(const Index& from, int axis) const;
  /// Appends the vertices of that grid-edge, upwards or downwards; without the one where it ends.
  void appendEdge(const Index& from, int axis, bool upwards, std::vector<uint32_t>& vertices);

  /// All positions: those of the cut-mesh and the added grid vertices.
  const std::vector<double>& positions() const { return positions_; }

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr uint8_t kGridVertex = 7;  // the mask with all three bits

  size_t cornerIndex(const Index& at) const {
    return size_t(at[0]) + size_t(cutMesh_.grid.cells(0) + 1) * (size_t(at[1]) + size_t(cutMesh_.grid.cells(1) + 1) * size_t(at[2]));
  }
  void linkAlongGridLines();
  void link(uint32_t from, uint32_t to, int axis);

  const CutMesh& cutMesh_;
  std::vector<double> positions_;
  std::vector<uint32_t> corners_;  // per crossing of planes, x fastest: vertex or none
  // 3 per cut-vertex. Of a grid vertex: the vertex that follows inside of the grid-edge up each axis. Of a vertex inside of a grid-edge:
  // its two neighbours there.
  std::vector<uint32_t> links_;
};

}  // namespace mandoline::detail
