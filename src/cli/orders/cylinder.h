// The vortices that a cylinder sheds into a wind.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mandoline::orders {

/// At a Reynolds number of 100, once it is periodic.
struct Shedding {
  double strouhal = 0;    ///< shed pairs per time, by diameter and wind
  double drag = 0;        ///< the mean coefficient
  double lift = 0;        ///< the largest coefficient
  double divergence = 0;  ///< the largest of all steps, as in FlowStep
  size_t cells = 0, steps = 0;
};

/// In a column of cells, one thick, `perDiameter` of them to a diameter near the cylinder and larger ones farther away; 18 diameters high.
/// Throws std::runtime_error if a step fails.
Shedding sheddingOf(int64_t perDiameter);

}  // namespace mandoline::orders
