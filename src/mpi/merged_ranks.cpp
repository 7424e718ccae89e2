#include "mpi/merged_ranks.h"

#include <algorithm>

#include "base/sort.h"
#include "mpi/absorbed_cells.h"
#include "mpi/ghost_layers.h"
#include "mpi/make_rank_complex.h"
#include "operators/merge/merge_parts.h"
#include "operators/require_cut_mesh.h"

namespace mandoline::detail {
namespace {

constexpr const char* kMerging = "merging of cells";

MergeOptions optionsOf(double fraction) {
  MergeOptions options;
  options.threads = 1;
  options.fraction = fraction;
  return options;
}

/// A process's cells as they become.
class RankMerger {
 public:
  RankMerger(const RankComplex& complex, const std::vector<Absorbed>& absorbed, const RankLayers& layers, int rank)
      : complex_(complex), absorbed_(absorbed), layers_(layers), rank_(rank) {
    for (const Absorbed& cell : absorbed) clusters_.push_back({cell.first, cell.layer, 1});
    sortItems(clusters_, [](const Cluster& a, const Cluster& b) { return a.first < b.first; });
    size_t count = 0;
    for (size_t i = 0; i < clusters_.size(); ++i) {
      if (count > 0 && clusters_[count - 1].first == clusters_[i].first)
        ++clusters_[count - 1].members;
      else
        clusters_[count++] = {clusters_[i].first, clusters_[i].layer, 2};
    }
    clusters_.resize(count);
  }

  void merge(double fraction) {
    std::vector<std::array<uint64_t, 2>> members;  // of those of several: the first, and a cell here
    for (uint32_t c = 0; c < complex_.cells.cellCount(); ++c) {
      if (const Cluster* cluster = clusterOf(c)) members.push_back({cluster->first, c});
    }
    sortItems(members, std::less<>());
    std::vector<std::array<uint32_t, 2>> pairs;
    for (size_t i = 1; i < members.size(); ++i) {
      if (members[i][0] == members[i - 1][0]) pairs.push_back({uint32_t(members[i - 1][1]), uint32_t(members[i][1])});
    }
    MergedCells merged = operators::mergePairs(complex_.cutMesh, complex_.cells, pairs, optionsOf(fraction));
    merged_ = std::move(merged.cells);
    merged_.madeFrom = complex_.cells.madeFrom;
    for (uint32_t c = 0; c < merged_.cellCount(); ++c) {
      const uint32_t member = merged_.membersOfCell(c)[0];
      const Cluster* cluster = clusterOf(member);
      ids_.push_back(idOf(cluster ? cluster->first : complex_.cellIds[member]));
      ranks_.push_back(cluster ? rankOf(cluster->layer) : complex_.cellRanks[member]);
      isComplete_.push_back(!cluster || merged_.membersOfCell(c).size() == cluster->members);
    }
    pockets_ = uint64_t(std::count_if(merged.pockets.begin(), merged.pockets.end(), [&](uint32_t c) { return ranks_[c] == rank_; }));
  }

  /// Whether so many rings around own cells are there, counted by layers.
  bool hasEnough(int rings) const {
    std::array<int64_t, 2> range = complex_.layers;
    if (range[0] == range[1]) return true;
    if (!addLayersOf([&](uint32_t c) { return ranks_[c] == rank_; }, range)) return false;
    for (int ring = 0; ring < rings; ++ring) {
      range = {std::max<int64_t>(range[0] - 1, 0), std::min<int64_t>(range[1] + 1, complex_.cutMesh.grid.cells(2))};
      if (!areHere(range)) return false;
      const std::array<int64_t, 2> before = range;
      const auto isIn = [&](uint32_t c) {
        const std::array<int64_t, 2> layers = layersOf(c);
        return layers[0] < before[1] && layers[1] > before[0];
      };
      if (!addLayersOf(isIn, range)) return false;
    }
    return true;
  }

  /// Of the process's own cells.
  uint64_t pockets() const { return pockets_; }

  RankComplex take(RankComplex complex) {
    complex.cells = std::move(merged_);
    complex.cellIds = std::move(ids_);
    complex.cellRanks = std::move(ranks_);
    complex.wholeCutCells = idOf(complex.wholeCutCells);
    complex.wholeCells -= absorbed_.size();
    return complex;
  }

 private:
  struct Cluster {
    uint64_t first;
    int64_t layer;
    size_t members;
  };

  /// Null for a cell that stays as it is.
  const Cluster* clusterOf(uint32_t cell) const {
    const uint64_t id = complex_.cellIds[cell];
    const auto at =
        std::lower_bound(absorbed_.begin(), absorbed_.end(), id, [](const Absorbed& a, uint64_t other) { return a.cell < other; });
    const uint64_t first = at != absorbed_.end() && at->cell == id ? at->first : id;
    const auto cluster =
        std::lower_bound(clusters_.begin(), clusters_.end(), first, [](const Cluster& a, uint64_t other) { return a.first < other; });
    return cluster != clusters_.end() && cluster->first == first ? &*cluster : nullptr;
  }

  /// How many merged cells come before a cell that is the first of its own: the id of that.
  uint64_t idOf(uint64_t first) const {
    const auto at =
        std::lower_bound(absorbed_.begin(), absorbed_.end(), first, [](const Absorbed& a, uint64_t other) { return a.cell < other; });
    return first - uint64_t(at - absorbed_.begin());
  }

  int32_t rankOf(int64_t layer) const {
    const auto at =
        std::find_if(layers_.begin(), layers_.end(), [&](const std::array<int64_t, 2>& of) { return of[0] <= layer && layer < of[1]; });
    return int32_t(at - layers_.begin());
  }

  bool areHere(const std::array<int64_t, 2>& layers) const {
    return layers[0] >= complex_.allLayers[0] && layers[1] <= complex_.allLayers[1];
  }

  std::array<int64_t, 2> layersOf(uint32_t mergedCell) const {
    const int64_t end = complex_.cutMesh.grid.cells(2);
    std::array<int64_t, 2> layers{end, 0};
    for (const size_t member : merged_.membersOfCell(mergedCell)) {
      const int64_t layer = complex_.cells.cellCorner[3 * member + 2], past = layer + (1 << complex_.cells.cellLevel[member]);
      layers = {std::min(layers[0], layer), std::max(layers[1], std::min(past, end))};
    }
    return layers;
  }

  /// Those of these cells; whether all are complete, and in the layers that are here.
  template <class IsOne>
  bool addLayersOf(const IsOne& isOne, std::array<int64_t, 2>& range) const {
    for (uint32_t c = 0; c < merged_.cellCount(); ++c) {
      if (!isOne(c)) continue;
      if (!isComplete_[c]) return false;
      const std::array<int64_t, 2> layers = layersOf(c);
      range = {std::min(range[0], layers[0]), std::max(range[1], layers[1])};
    }
    return areHere(range);
  }

  const RankComplex& complex_;
  const std::vector<Absorbed>& absorbed_;
  const RankLayers& layers_;
  const int rank_;
  std::vector<Cluster> clusters_;  // of several cells, by the first
  CellComplex merged_;
  std::vector<uint64_t> ids_;
  std::vector<int32_t> ranks_;
  std::vector<uint8_t> isComplete_;
  uint64_t pockets_ = 0;
};

/// Cells with so many rings of ghosts, merged.
RankComplex merged(Communicator& comm, const DistributedCut& cut, const RankPiece& piece, const RankMerging& merging,
                   MergedCounts& counts) {
  const int usual = merging.rings + 2;  // few merged cells reach farther
  const RankLayers layers = layersOfAll(comm, piece.layers);
  std::optional<std::vector<Absorbed>> absorbed;
  for (int ghosts = usual;; ++ghosts) {
    RankComplex complex = cut.cellComplex(piece, ghosts, merging.coarsening);
    if (!absorbed) absorbed = absorbedCells(comm, cut.common().mesh, complex, optionsOf(merging.fraction));
    std::optional<RankMerger> merger;
    bool hasEnough = false;
    comm.together(kMerging, [&] {
      merger.emplace(complex, *absorbed, layers, comm.rank());
      merger->merge(merging.fraction);
      hasEnough = merger->hasEnough(merging.rings);
    });
    if (comm.reduce(int(hasEnough), MPI_MIN) == 0) continue;
    counts = {complex.wholeCells, complex.wholeCells - absorbed->size(), comm.reduce(merger->pockets(), MPI_SUM)};
    comm.together(kMerging, [&] { complex = merger->take(std::move(complex)); });
    return complex;
  }
}

void requireSize(const Grid& grid) {
  double size = 0;
  for (const std::vector<double>& planes : grid.planes) size = std::max(size, planes.back() - planes.front());
  operators::requireLength(size);
}

/// Of faces that are joined of some before.
void finishFaces(RankComplex& complex, int rank) {
  const std::vector<uint64_t> before = std::move(complex.faceIds);
  complex.faceIds.clear();
  for (size_t f = 0; f < complex.cells.faceCount(); ++f) complex.faceIds.push_back(before[complex.cells.membersOfFace(f)[0]]);
  complex.seams = seamsOf(complex.cells, complex.cellRanks, rank);
}

}  // namespace

RankComplex mergedComplex(Communicator& comm, const DistributedCut& cut, const RankPiece& piece, const RankMerging& merging,
                          MergedCounts* counts) {
  MergedCounts found;
  const bool isMerged = merging.fraction > 0;
  comm.together(kMerging, [&] {
    if (isMerged || merging.walls) requireSize(cut.common().mesh.grid);
  });
  RankComplex complex = isMerged ? merged(comm, cut, piece, merging, found) : cut.cellComplex(piece, merging.rings, merging.coarsening);
  comm.together(kMerging, [&] {
    if (!isMerged && !merging.walls) return;
    if (merging.walls) complex.cells = operators::uniteWallsOf(complex.cutMesh, complex.cells, *merging.walls);
    finishFaces(complex, comm.rank());
  });
  if (counts) *counts = found;
  return complex;
}

}  // namespace mandoline::detail
