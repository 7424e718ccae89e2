// A point of a cut-cell that its generalized winding number is taken at.
#pragma once

#include <vector>

#include "base/point.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline::operators {

struct CellSample {
  detail::Point point{};
  // On a triangle, where a cell has nothing else: those that hold it are left out, and the cell's side of them is told.
  std::vector<uint32_t> leftOut;
  double step = 0;  ///< the winding number in the cell less that without them
};

/// The centre of the largest triangle of a piece of a grid-face, which is off the mesh; of a cell without such pieces, of the largest
/// triangle of its surface.
class CellSampler {
 public:
  /// `isOpen`: per triangle, whether it belongs to an open part. Keeps references to both.
  CellSampler(const CutMesh& cutMesh, const std::vector<uint8_t>& isOpen)
      : cutMesh_(cutMesh), isOpen_(isOpen), triangulator_(cutMesh.positions) {}

  CellSample sample(uint32_t cell);

 private:
  detail::Point vertex(uint32_t v) const {
    const double* p = &cutMesh_.positions[3 * size_t(v)];
    return {p[0], p[1], p[2]};
  }

  const CutMesh& cutMesh_;
  const std::vector<uint8_t>& isOpen_;
  FaceTriangulator triangulator_;
  std::vector<uint32_t> triangles_;
};

}  // namespace mandoline::operators
