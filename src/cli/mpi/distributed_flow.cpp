#ifdef MANDOLINE_HAVE_PETSC

#include "cli/mpi/distributed_flow.h"

#include "cli/interrupt.h"
#include "cli/mpi/flow/merged_ranks.h"
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
  constexpr const char* kNoun = "flow";
  std::vector<double> whole;
  detail::Communicator::Bytes own;
  comm.together(kNoun, [&] {
    Values values;
    for (size_t c = 0; c < phi.size(); ++c) {
      if (complex.cellRanks[c] != comm.rank()) continue;
      values.cells.push_back(complex.cellIds[c]);
      values.phi.push_back(phi[c]);
    }
    own = detail::packed(values);
    if (comm.rank() == 0) whole.resize(complex.wholeCells);
  });
  for (int rank = 0; rank < comm.size(); ++rank) {
    const bool isSent = rank > 0;
    const detail::Communicator::Bytes told =
        comm.exchange(own, isSent && comm.rank() == rank ? 0 : -1, isSent && comm.rank() == 0 ? rank : -1);
    comm.together(kNoun, [&] {
      if (comm.rank() > 0) return;
      const Values values = detail::unpacked<Values>(isSent ? told : own);
      for (size_t i = 0; i < values.cells.size(); ++i) whole.at(values.cells[i]) = values.phi[i];
    });
  }
  return whole;
}

}  // namespace

void checkDistributedFlow(const Arguments& arguments) {
  checkFlowOutputs(arguments);
  if (arguments.flow.corrections.value_or(1) > 0)
    throw UsageError("several processes solve without corrections: --corrections 0 says that this is what is wanted");
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
  const RankComplex complex = mergedComplex(comm, cut, mergeFraction(arguments));
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
