// Potential flow on the cells of several processes.
#pragma once

#include "mandoline/distributed.h"
#include "mandoline/flow.h"
#include "mpi/communicator.h"
#include "physics/flow_of_phi.h"

namespace mandoline::cli {

/// Rings of ghosts that velocities and corrections of own cells follow from.
constexpr int kFlowGhosts = 3;

struct RankFlowOptions {
  int corrections = 0;  ///< at most
  bool farField = false;
  std::function<void()> onIteration;  ///< may be null
};

/// A process's part of a flow.
struct RankFlow {
  /// phi and cellVelocity are per cell of the process, ghosts among them, whose velocities are none. The rest but madeFrom, faceVelocity,
  /// cellGradient and cellPressure is that of the whole.
  Flow flow;
  std::vector<physics::FaceCorrection> corrections;  ///< of the process's faces, those of ghosts among them
  std::vector<physics::FaceCorrection> onSides;      ///< likewise, of the box: what the far field adds to the wind
  int iterations = 0;                                ///< of conjugate gradients
  double imbalance = 0;  ///< the largest sum of the flow through the faces of a cell, relative to the largest flow through a face
};

/// As solveFlow() with at most so many corrections; phi agrees with that of solveFlow() within the tolerance, with corrections within what
/// these leave, and in the far field within what its passes leave. `complex` is that of mergedComplex() with kFlowGhosts. Collective.
/// Throws RankError, also as solveFlow() has errors, and as PetscSolver does, whose onIteration is as well.
RankFlow solveRankFlow(detail::Communicator& comm, const RankComplex& complex, const std::array<double, 3>& wind,
                       const RankFlowOptions& options);

}  // namespace mandoline::cli
