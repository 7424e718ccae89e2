// What a flow in time does on the boundary.
#pragma once

#include "mandoline/unsteady.h"

namespace mandoline::physics {

/// Half-faces of the boundary by what passes through them.
struct FlowBoundary {
  enum class Kind : uint8_t { surface, inflow, outlet, side };

  /// Where the wind is throttled to nothing, inflow and outlets are sides.
  FlowBoundary(const CellComplex& cells, const std::array<double, 3>& wind);

  Boundary boundary;                ///< its value is what flows out of inflow and sides
  std::vector<Kind> kinds;          ///< per half-face of the boundary
  std::vector<uint32_t> surface;    ///< half-faces
  std::vector<uint32_t> outlets;    ///< half-faces
  std::vector<uint32_t> outletsAt;  ///< their places in the boundary
  std::vector<double> inflow;       ///< 3 per half-face of the boundary: the velocity on inflow; 0 elsewhere

  /// Conditions for the pressure: 0 on outlets.
  Boundary ofPressure() const;
  /// Conditions for a component of the velocity that sticks to the surface.
  Boundary ofVelocity(const CellComplex& cells, size_t axis) const;
  /// Their values.
  std::vector<double> velocities(size_t axis) const;
};

}  // namespace mandoline::physics
