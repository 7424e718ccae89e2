// What is known of a flow: how fast it passes through faces.
#pragma once

#include "base/csr.h"
#include "base/parallel.h"
#include "mandoline/flow.h"
#include "physics/dual_edges.h"

namespace mandoline::physics {

/// The velocity's component along a normal near a point, which weighs as much as the area that it holds for.
struct FlowDatum {
  std::array<double, 3> point, normal;
  double value, weight;
};

struct FlowData {
  std::vector<FlowDatum> data;
  detail::Csr<uint32_t> cellData;       ///< per cell, ascending: its dual edges and half-faces of the boundary
  detail::Csr<uint32_t> cellNeighbors;  ///< per cell, ascending: those whose data also tell of the flow in it
  std::vector<double> cellSize;         ///< per cell: of the distance between dual points
};

/// Fills in the flow's velocities of faces: on the boundary those given there, elsewhere those from phi.
MANDOLINE_SHARED void fillFaceVelocities(const CellComplex& cells, const Boundary& boundary, const DualEdges& dual, Flow& flow);

/// `flow` has the faces' velocities.
MANDOLINE_SHARED FlowData flowData(const CellComplex& cells, const DualEdges& dual, const Flow& flow);

/// Fills in the flow's velocities and gradients in cells.
MANDOLINE_SHARED void fitVelocities(const CellComplex& cells, const FlowData& data, detail::Monitor& monitor, Flow& flow);

}  // namespace mandoline::physics
