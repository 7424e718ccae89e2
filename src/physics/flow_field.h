// A flow's cells: which one holds a point, and the velocity in it.
#pragma once

#include "mandoline/flow.h"
#include "operators/cut_input.h"

namespace mandoline::physics {

/// The mesh that was cut. Throws CallError{badArgument} if the field's parts do not belong together, or the number of coordinates is not a
/// multiple of 3.
operators::CutInput requireField(const FlowField& field, std::span<const double> points);

/// The cells before any were merged: cut-cells, then octree cells.
struct FieldMembers {
  OctreeCells octree;
  std::vector<uint32_t> cellOf;  ///< per member: the cell that it belongs to
};

/// Throws CallError{badArgument} if the members are not those of the cut-mesh.
FieldMembers membersOf(const FlowField& field);

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
