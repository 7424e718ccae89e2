#include "cli/mpi/flow/rank_wind.h"

#include <algorithm>
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "physics/wind.h"

namespace mandoline::cli {
namespace {

constexpr uint32_t kNone = ~0u;

/// Those of whole regions are the regions; numbered by their first cells.
CellComponents componentsOf(detail::Communicator& comm, const RankComplex& complex) {
  std::vector<uint64_t> first(complex.cutMesh.regionCount, ~uint64_t(0));
  for (size_t c = 0; c < complex.cellIds.size(); ++c) {
    uint64_t& least = first[complex.cells.cellRegion[c]];
    least = std::min(least, complex.cellIds[c]);
  }
  comm.reduce(first, MPI_MIN);
  std::vector<uint32_t> byFirst(first.size()), numbers(first.size());
  std::iota(byFirst.begin(), byFirst.end(), 0u);
  detail::sortItems(byFirst, [&](uint32_t a, uint32_t b) { return first[a] < first[b]; });
  for (uint32_t i = 0; i < byFirst.size(); ++i) numbers[byFirst[i]] = i;
  CellComponents components;
  components.count = complex.cutMesh.regionCount;
  for (const uint32_t region : complex.cells.cellRegion) components.cellComponent.push_back(numbers[region]);
  return components;
}

/// The parts between slits of the whole: those that each process sees, joined where they have a cell in common.
CellComponents partsOf(detail::Communicator& comm, const RankComplex& complex, const Halo& halo) {
  CellComponents parts;
  comm.together("flow", [&] { parts = physics::partsBetweenSlits(complex.cells); });
  const std::vector<uint64_t> counts = comm.gatherAll(uint64_t(parts.count));
  const uint64_t before = std::accumulate(counts.begin(), counts.begin() + comm.rank(), uint64_t(0));
  for (uint32_t& part : parts.cellComponent) part += uint32_t(before);
  std::vector<uint32_t> others = parts.cellComponent;
  halo.update(others);
  std::vector<std::array<uint32_t, 2>> pairs;
  for (size_t c = 0; c < others.size(); ++c) {
    if (others[c] != parts.cellComponent[c]) pairs.push_back({parts.cellComponent[c], others[c]});
  }
  detail::sortUnique(pairs);
  std::vector<uint32_t> flat;
  for (const auto& [a, b] : pairs) flat.insert(flat.end(), {a, b});
  parts.count = uint32_t(std::accumulate(counts.begin(), counts.end(), uint64_t(0)));
  detail::DisjointSets sets(parts.count);
  for (const std::vector<uint32_t>& all : comm.gatherAll(flat)) {
    for (size_t i = 0; i < all.size(); i += 2) sets.unite(all[i], all[i + 1]);
  }
  for (uint32_t& part : parts.cellComponent) part = sets.find(part);
  return parts;
}

}  // namespace

RankWind rankWind(detail::Communicator& comm, const RankComplex& complex, const Halo& halo, const std::array<double, 3>& wind) {
  RankWind result;
  result.components = componentsOf(comm, complex);
  result.parts = partsOf(comm, complex, halo);
  const CellComponents& parts = result.parts;
  std::vector<uint32_t> ownPart = parts.cellComponent;  // each cell counts once
  for (size_t c = 0; c < ownPart.size(); ++c) {
    if (complex.cellRanks[c] != comm.rank()) ownPart[c] = kNone;
  }
  physics::WindThrough through;
  comm.together("flow", [&] {
    result.boundary = physics::freeWind(complex.cells, wind);
    through = physics::windThrough(complex.cells, result.boundary, ownPart, parts.count);
  });
  comm.reduce(through.in, MPI_SUM);
  comm.reduce(through.out, MPI_SUM);
  // Ghosts get what their processes give them; their wind counts there.
  Boundary ofOwn = result.boundary;
  physics::WindLost lost = physics::throttle(complex.cells, through, ownPart, result.components, ofOwn);
  physics::throttle(complex.cells, through, parts.cellComponent, result.components, result.boundary);
  comm.reduce(lost.all, MPI_SUM);
  comm.reduce(lost.lost, MPI_SUM);
  result.throttled = lost.throttled();
  return result;
}

}  // namespace mandoline::cli
