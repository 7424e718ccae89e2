#ifdef MANDOLINE_HAVE_PETSC

#include "cli/mpi/distributed_flow.h"

#include <algorithm>

#include "cli/cutting.h"
#include "cli/interrupt.h"
#include "cli/mpi/flow/rank_flow.h"
#include "cli/mpi/merging.h"
#include "mpi/pack.h"
#include "physics/flow_of_phi.h"

namespace mandoline::cli {
namespace {

/// Of cells of one process, by the ids of the whole.
struct Values {
  std::vector<uint64_t> cells;
  std::vector<double> phi;
  std::vector<uint64_t> correctedCells;     ///< per correction a cell of its face: that which the normal points out of, if any
  std::vector<uint32_t> correctedFaces;     ///< which of the faces of that
  std::vector<double> correctedVelocities;  ///< and what is added there

  static void fields(auto& self, const auto& f) {
    f("cells", self.cells);
    f("phi", self.phi);
    f("correctedCells", self.correctedCells);
    f("correctedFaces", self.correctedFaces);
    f("correctedVelocities", self.correctedVelocities);
  }
};

Values valuesOf(const RankComplex& complex, int rank, const RankFlow& found) {
  Values values;
  for (size_t c = 0; c < found.flow.phi.size(); ++c) {
    if (complex.cellRanks[c] != rank) continue;
    values.cells.push_back(complex.cellIds[c]);
    values.phi.push_back(found.flow.phi[c]);
  }
  for (const auto* corrections : {&found.corrections, &found.onSides}) {
    for (const auto& [face, velocity] : *corrections) {
      const int32_t* cells = &complex.cells.faceCells[2 * size_t(face)];
      const auto cell = size_t(cells[0] >= 0 ? cells[0] : cells[1]);
      if (complex.cellRanks[cell] != rank) continue;
      const auto halfFaces = complex.cells.halfFaces(cell);
      values.correctedCells.push_back(complex.cellIds[cell]);
      values.correctedFaces.push_back(uint32_t(std::lower_bound(halfFaces.begin(), halfFaces.end(), 2 * face) - halfFaces.begin()));
      values.correctedVelocities.push_back(velocity);
    }
  }
  return values;
}

/// Those of all processes, in the first one.
std::vector<Values> gather(detail::Communicator& comm, const RankComplex& complex, const RankFlow& found) {
  constexpr const char* kNoun = "flow";
  std::vector<Values> all;
  detail::Communicator::Bytes own;
  comm.together(kNoun, [&] { own = detail::packed(valuesOf(complex, comm.rank(), found)); });
  for (int rank = 0; rank < comm.size(); ++rank) {
    const bool isSent = rank > 0;
    const detail::Communicator::Bytes told =
        comm.exchange(own, isSent && comm.rank() == rank ? 0 : -1, isSent && comm.rank() == 0 ? rank : -1);
    comm.together(kNoun, [&] {
      if (comm.rank() == 0) all.push_back(detail::unpacked<Values>(isSent ? told : own));
    });
  }
  return all;
}

/// Of the whole.
Flow flowOf(const std::vector<Values>& all, const CellComplex& cells, const std::array<double, 3>& wind, const RunOptions& options) {
  std::vector<double> phi(cells.cellCount());
  std::vector<physics::FaceCorrection> corrections;
  for (const Values& values : all) {
    for (size_t i = 0; i < values.cells.size(); ++i) phi.at(values.cells[i]) = values.phi[i];
    for (size_t i = 0; i < values.correctedCells.size(); ++i)
      corrections.push_back({cells.halfFaces(values.correctedCells[i])[values.correctedFaces[i]] / 2, values.correctedVelocities[i]});
  }
  return physics::flowOfPhi(cells, wind, std::move(phi), corrections, options);
}

}  // namespace

void checkDistributedFlow(const Arguments& arguments) {
  checkFlowOutputs(arguments);
  refuseOptions({{arguments.refines(), arguments.refineOption()}, {arguments.flow.steps.has_value(), "--steps"}}, "",
                ": a flow of several processes has none; mandoline flow does");
}

SolveCells solveDistributed(Ranks& ranks, const Arguments& arguments, const DistributedCut& cut, const TriangleGroups& groups) {
  detail::Communicator& comm = ranks.comm();
  std::optional<Merging> merging;  // which takes memory
  ranks.together([&] { merging.emplace(arguments, groups, RunOptions{1, {}}); });
  const RankComplex complex = detail::mergedComplex(comm, cut, cut.piece(), merging->with(kFlowGhosts));
  const std::array<double, 3> wind = *arguments.flow.wind;
  RankFlowOptions solving;
  solving.corrections = arguments.flow.corrections.value_or(FlowOptions().corrections);
  solving.farField = arguments.flow.farField;
  solving.onIteration = throwIfInterrupted;
  const RankFlow found = solveRankFlow(comm, complex, wind, solving);
  std::vector<Values> all = gather(comm, complex, found);
  return [=, status = found.flow.status, residuals = found.flow.residuals](const CellComplex& cells, const RunOptions& options) {
    Flow flow = flowOf(all, cells, wind, options);
    if (flow.status == SolveStatus::converged) flow.status = status;
    flow.residuals = residuals;
    return flow;
  };
}

}  // namespace mandoline::cli

#endif
