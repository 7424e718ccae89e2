// How values in cells give those on the faces between them, and the other way round.
#pragma once

#include "mandoline/cell_complex.h"
#include "physics/fit_data.h"

namespace mandoline::physics {

/// A face that two cells exchange fluxes through.
struct FlowFace {
  uint32_t face;
  std::array<uint32_t, 2> cells;  ///< on side 0 and on side 1
  double share;                   ///< of cell 1 in a value half-way: where the plane of the face meets the line between centroids
  Point step;                     ///< from the centroid of cell 0 to that of cell 1
  Point skew;                     ///< from that line to the centroid of the face
  bool isSkewed;
};

class FlowCells {
 public:
  /// `wall`: the half-faces that velocities are zero on.
  FlowCells(const CellComplex& cells, std::span<const uint32_t> wall, std::span<const uint32_t> outlets);

  const std::vector<FlowFace>& faces() const { return faces_; }

  /// 9 per cell: for each of three components of the velocity its gradient, by least squares over the neighbours and the wall.
  void gradients(const std::vector<double>& velocity, std::vector<double>& result) const;

  /// 3 per cell: the vector whose components along the normals of the cell's faces, and the outlets, are nearest to the derivatives there,
  /// by least squares weighted by area. `outlet`: per outlet, along the normal that points out of the cell.
  void vectors(const std::vector<double>& faceDerivative, const std::vector<double>& outlet, std::vector<double>& result) const;

  /// Per FlowFace: the component of the velocity along its normal.
  double normalVelocity(const FlowFace& face, const std::vector<double>& velocity, const std::vector<double>& gradients) const;

 private:
  void setSlopes(std::span<const uint32_t> wall);
  void setNormals(std::span<const uint32_t> outlets);

  const CellComplex& cells_;
  std::vector<FlowFace> faces_;
  std::vector<std::array<Point, 2>> slopes_;   // per face: what the difference of its cells adds to the gradients in them
  std::vector<Point> wallSlopes_;              // per cell: what the value itself takes from the gradient, so that it is zero at the wall
  std::vector<std::array<Point, 2>> normals_;  // per face: what its derivative adds to the vectors in its cells
  std::vector<uint32_t> outletCells_;
  std::vector<Point> outletNormals_;
};

}  // namespace mandoline::physics
