// Potential flow on the cells of several processes.
#pragma once

#include "mandoline/distributed.h"
#include "mandoline/flow.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

/// A process's part of a flow.
struct RankFlow {
  /// phi and cellVelocity are per cell of the process, ghosts among them, whose velocities are none. The rest but madeFrom, faceVelocity,
  /// cellGradient and cellPressure is that of the whole.
  Flow flow;
  int iterations = 0;    ///< of conjugate gradients
  double imbalance = 0;  ///< the largest sum of the flow through the faces of a cell, relative to the largest flow through a face
};

/// As solveFlow() without corrections; phi is that within the tolerance. `complex` is that of mergedComplex(). Collective. Throws
/// RankError, and as PetscSolver does, whose onIteration is as well.
RankFlow solveRankFlow(detail::Communicator& comm, const RankComplex& complex, const std::array<double, 3>& wind,
                       const std::function<void()>& onIteration = nullptr);

}  // namespace mandoline::cli
