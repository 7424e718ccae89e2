// A potential flow that another solver has found.
#pragma once

#include "base/shared.h"
#include "mandoline/flow.h"

namespace mandoline::physics {

/// What is added to the velocity on a face along the normal: to what differences of phi are, and on a side of the box to the wind.
struct FaceCorrection {
  uint32_t face;
  double velocity;
};

/// What follows from its phi, which solves the system with these corrections. The wind has a length that doubles can have.
MANDOLINE_SHARED Flow flowOfPhi(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<double> phi,
                                std::span<const FaceCorrection> corrections, const RunOptions& options);

/// What passes out of the boundary is the velocity on its faces.
MANDOLINE_SHARED void setOnBoundary(const Boundary& boundary, std::vector<double>& faceVelocity);

}  // namespace mandoline::physics
