#ifdef MANDOLINE_HAVE_PETSC

#include "cli/mpi/distributed_flow.h"

#include "cli/interrupt.h"
#include "cli/mpi/flow/rank_flow.h"
#include "mpi/pack.h"
#include "physics/flow_of_phi.h"

namespace mandoline::cli {
namespace {

/// Of cells of one process.
struct Values {
  std::vector<uint64_t> cells;
  std::vector<double> phi;

  static void fields(auto& self, const auto& f) {
    f("cells", self.cells);
    f("phi", self.phi);
  }
};

/// phi by the ids of the whole, in the first process.
std::vector<double> gather(detail::Communicator& comm, const RankComplex& complex, const std::vector<double>& phi) {
  Values own;
  for (size_t c = 0; c < phi.size(); ++c) {
    if (complex.cellRanks[c] != comm.rank()) continue;
    own.cells.push_back(complex.cellIds[c]);
    own.phi.push_back(phi[c]);
  }
  if (comm.rank() > 0) {
    comm.send(detail::packed(own), 0);
    return {};
  }
  std::vector<double> whole(complex.wholeCells);
  for (int rank = 0; rank < comm.size(); ++rank) {
    if (rank > 0) own = detail::unpacked<Values>(comm.receive(rank));
    for (size_t i = 0; i < own.cells.size(); ++i) whole.at(own.cells[i]) = own.phi[i];
  }
  return whole;
}

}  // namespace

void checkDistributedFlow(const Arguments& arguments) {
  checkFlowOutputs(arguments);
  if (arguments.flow.corrections.value_or(1) > 0)
    throw UsageError("several processes solve without corrections: --corrections 0 says that this is what is wanted");
  if (mergeFraction(arguments) > 0) throw UsageError("several processes do not merge cells: --merge 0 says that this is what is wanted");
  const std::pair<bool, const char*> others[] = {{arguments.coarsen.value_or(0) > 0, "--coarsen"},
                                                 {arguments.refines(), "--refine"},
                                                 {arguments.uniteWalls.has_value(), "--unite-walls"},
                                                 {arguments.flow.farField, "--far-field"},
                                                 {arguments.flow.steps.has_value(), "--steps"}};
  for (const auto& [isGiven, name] : others) {
    if (isGiven) throw UsageError(std::string(name) + ": a flow of several processes has none; mandoline flow does");
  }
}

SolveCells solveDistributed(Ranks& ranks, const Arguments& arguments, const DistributedCut& cut) {
  detail::Communicator& comm = ranks.comm();
  const RankComplex complex = cut.cellComplex(cut.piece(), kFlowGhosts);
  const std::array<double, 3> wind = *arguments.flow.wind;
  const RankFlow found = solveRankFlow(comm, complex, wind, throwIfInterrupted);
  std::vector<double> phi = gather(comm, complex, found.flow.phi);
  return [=, status = found.flow.status, residuals = found.flow.residuals](const CellComplex& cells, const RunOptions& options) {
    Flow flow = physics::flowOfPhi(cells, wind, phi, options);
    if (flow.status == SolveStatus::converged) flow.status = status;
    flow.residuals = residuals;
    return flow;
  };
}

}  // namespace mandoline::cli

#endif
