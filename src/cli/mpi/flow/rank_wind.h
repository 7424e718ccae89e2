// A wind through the cells of several processes.
#pragma once

#include "cli/mpi/flow/halo.h"
#include "mandoline/poisson.h"

namespace mandoline::cli {

struct RankWind {
  Boundary boundary;                ///< that of the process's cells, ghosts among them; as windBoundary() of the whole
  CellComponents components;        ///< of the whole, per cell of the process
  CellComponents parts;             ///< between slits, likewise; some numbers stand for no part
  std::vector<uint32_t> throttled;  ///< of the components
};

/// Collective.
RankWind rankWind(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const std::array<double, 3>& wind);

}  // namespace mandoline::cli
