// The dual edges of a cell complex: which cells exchange fluxes through which faces, and over what distance.
#pragma once

#include "base/csr.h"
#include "base/shared.h"
#include "mandoline/operators.h"

namespace mandoline::physics {

/// The faces through which a cell exchanges fluxes with one other, or with several smaller ones on one of its sides.
struct DualEdge {
  uint32_t cell;    ///< the one cell
  double sign;      ///< 1 if the faces' normals point out of it, -1 if into it
  double distance;  ///< along the normal, from its dual point to the mean one of the others, by what flows to them; positive
  double area;      ///< of all faces
  double flow;      ///< per derivative: the sum of areas times coefficients
};

struct DualEdges {
  std::vector<DualEdge> edges;
  detail::Csr<uint32_t> faces;       ///< per dual edge, ascending
  std::vector<double> coefficients;  ///< as PoissonProblem::faceCoefficient

  /// What flows through a face per derivative: its area times its coefficient.
  double flowOf(const CellComplex& cells, size_t f) const {
    return coefficients.empty() ? cells.faceArea[f] : coefficients[f] * cells.faceArea[f];
  }
};

/// In the order of their first faces.
MANDOLINE_SHARED DualEdges dualEdges(const CellComplex& cells, DualPoints dualPoints, std::vector<double> coefficients = {},
                                     unsigned threads = 1);

inline bool isInner(const CellComplex& cells, size_t f) {
  return cells.faceTag[f] == FaceTag::inner && cells.faceCells[2 * f] >= 0 && cells.faceCells[2 * f + 1] >= 0;
}
inline const std::vector<double>& pointsOf(const CellComplex& cells, DualPoints dualPoints) {
  return dualPoints == DualPoints::centres ? cells.cellCentre : cells.cellCentroid;
}

/// The part of what flows along a dual edge that passes through one of its faces.
inline double shareOf(const CellComplex& cells, const DualEdges& dual, size_t e, size_t f) {
  const size_t count = dual.faces[e].size();
  if (count == 1) return 1;
  return dual.edges[e].flow > 0 ? dual.flowOf(cells, f) / dual.edges[e].flow : 1 / double(count);
}

/// The cell on the other side of a face of a dual edge.
inline uint32_t otherCell(const CellComplex& cells, const DualEdge& edge, size_t f) {
  return uint32_t(cells.faceCells[2 * f + (edge.sign > 0 ? 1 : 0)]);
}

/// The mean of phi in the other cells of a dual edge, by what flows to them, less that in the one cell.
inline double differenceAt(const CellComplex& cells, const DualEdges& dual, size_t e, const std::vector<double>& phi) {
  const DualEdge& edge = dual.edges[e];
  double others = 0;
  for (const uint32_t f : dual.faces[e]) others += shareOf(cells, dual, e, f) * phi[otherCell(cells, edge, f)];
  return others - phi[edge.cell];
}

}  // namespace mandoline::physics
