// A flow's cells: which one holds a point, and the velocity in it.
#pragma once

#include <optional>

#include "mandoline/flow.h"
#include "operators/cell_complex/octree_index.h"
#include "operators/cut_input.h"
#include "operators/locate/walls.h"

namespace mandoline::physics {

/// The mesh that was cut. Throws CallError{badArgument} if the field's parts do not belong together, or the number of coordinates is not a
/// multiple of 3.
operators::CutInput requireField(const FlowField& field, std::span<const double> points);

/// The cells before any were merged, and the blocks that they fill: grid cells, octree cells, or those of refined cells.
class FieldMembers {
 public:
  /// Throws CallError{badArgument} if the members are not those of the cut-mesh.
  explicit FieldMembers(const FlowField& field);
  FieldMembers(const FieldMembers&) = delete;

  /// The members in the block that holds a grid cell: cut-cells, or one that is untouched; none if the arrays are damaged.
  IdRange in(const operators::GridCell& at) const;
  bool isCut(size_t member) const { return member < cutCells_; }
  /// The block of a member: its lowest grid cell, and one past its last.
  operators::GridCell cornerOf(size_t member) const { return blocks_.corner(blocksOf_[member]); }
  operators::GridCell endOf(size_t member) const { return blocks_.end(blocksOf_[member]); }
  /// Along each axis, of one with cut-cells.
  int32_t blockSize(size_t member) const { return 1 << blocks_.cellLevel[blocksOf_[member]]; }
  /// The cell that a member belongs to.
  uint32_t cellOf(size_t member) const { return cellOf_[member]; }

 private:
  void addBlock(const int32_t* corner, uint8_t level, size_t firstMember);
  void findLevels();

  size_t cutCells_;
  OctreeCells blocks_;
  std::vector<uint32_t> firstMembers_;  // per block, and the number of all
  std::vector<uint32_t> blocksOf_;      // per member
  std::vector<uint32_t> cellOf_;        // per member
  std::optional<operators::OctreeIndex> index_;
};

/// Per point: the member that holds it, or -1 outside the grid.
std::vector<int64_t> membersAt(const FlowField& field, const FieldMembers& members, std::span<const double> points);

inline std::array<double, 3> velocityIn(const CellComplex& cells, const Flow& flow, size_t cell, const double* point) {
  const double *v = &flow.cellVelocity[3 * cell], *g = &flow.cellGradient[6 * cell];
  double r[3];
  for (size_t d = 0; d < 3; ++d) r[d] = point[d] - cells.cellCentroid[3 * cell + d];
  return {v[0] + (g[0] * r[0] + g[3] * r[1] + g[5] * r[2]), v[1] + (g[3] * r[0] + g[1] * r[1] + g[4] * r[2]),
          v[2] + (g[5] * r[0] + g[4] * r[1] + g[2] * r[2])};
}

}  // namespace mandoline::physics
