// A potential flow that another solver has found.
#pragma once

#include "base/shared.h"
#include "mandoline/flow.h"

namespace mandoline::physics {

/// What is added to the velocity on a face, beside what differences of phi are, along the normal.
struct FaceCorrection {
  uint32_t face;
  double velocity;
};

/// What follows from its phi, which solves the system with these corrections. The wind has a length that doubles can have.
MANDOLINE_SHARED Flow flowOfPhi(const CellComplex& cells, const std::array<double, 3>& wind, std::vector<double> phi,
                                std::span<const FaceCorrection> corrections, const RunOptions& options);

}  // namespace mandoline::physics
