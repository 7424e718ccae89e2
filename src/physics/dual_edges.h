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
  double distance;  ///< along the normal, from its dual point to the mean one of the others by area; positive
  double area;      ///< of all faces
};

struct DualEdges {
  std::vector<DualEdge> edges;
  detail::Csr<uint32_t> faces;  ///< per dual edge, ascending
};

/// In the order of their first faces.
MANDOLINE_SHARED DualEdges dualEdges(const CellComplex& cells, DualPoints dualPoints);

inline bool isInner(const CellComplex& cells, size_t f) {
  return cells.faceTag[f] == FaceTag::inner && cells.faceCells[2 * f] >= 0 && cells.faceCells[2 * f + 1] >= 0;
}
inline const std::vector<double>& pointsOf(const CellComplex& cells, DualPoints dualPoints) {
  return dualPoints == DualPoints::centres ? cells.cellCentre : cells.cellCentroid;
}

/// The part of a dual edge's area that one of its faces has.
inline double shareOf(const CellComplex& cells, const DualEdge& edge, std::span<const uint32_t> faces, size_t f) {
  if (faces.size() == 1) return 1;
  return edge.area > 0 ? cells.faceArea[f] / edge.area : 1 / double(faces.size());
}

/// The cell on the other side of a face of a dual edge.
inline uint32_t otherCell(const CellComplex& cells, const DualEdge& edge, size_t f) {
  return uint32_t(cells.faceCells[2 * f + (edge.sign > 0 ? 1 : 0)]);
}

}  // namespace mandoline::physics
