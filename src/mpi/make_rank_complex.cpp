#include "mpi/make_rank_complex.h"

#include <algorithm>

#include "mpi/communicator.h"
#include "mpi/ghost_layers.h"
#include "mpi/untouched_order.h"
#include "operators/cell_complex/in_layers.h"
#include "operators/coarsen/block_tree.h"
#include "operators/coarsen/coarsen_runs.h"
#include "operators/measure/measure_part.h"

namespace mandoline::detail {
namespace {

constexpr const char* kNoun = "assembly of the cells";

/// The layers that own cells and so many rings of cells around them reach into, at most. A process's own are the cells of these layers, and
/// octree cells that begin there.
std::array<int64_t, 2> layersAround(const OctreeCells& octree, std::array<int64_t, 2> own, int rings) {
  std::array<int64_t, 2> range = own;
  const auto add = [&](size_t c) {
    range = {std::min<int64_t>(range[0], octree.corner(c)[2]), std::max<int64_t>(range[1], octree.end(c)[2])};
  };
  for (size_t c = 0; c < octree.cellCount(); ++c) {
    if (octree.corner(c)[2] >= own[0] && octree.corner(c)[2] < own[1]) add(c);
  }
  for (int ring = 0; ring < rings; ++ring) {
    const std::array<int64_t, 2> touched{range[0] - 1, range[1] + 1};
    range = {std::max<int64_t>(touched[0], 0), std::min<int64_t>(touched[1], octree.gridCells[2])};
    for (size_t c = 0; c < octree.cellCount(); ++c) {
      if (octree.corner(c)[2] < touched[1] && octree.end(c)[2] > touched[0]) add(c);
    }
  }
  return range;
}

class ComplexMaker {
 public:
  ComplexMaker(Communicator& comm, const WholeCut& whole, RankLayers layers) : comm_(comm), whole_(whole), layers_(std::move(layers)) {}

  RankComplex make(const RankPiece& piece, int ghosts, const CoarsenOptions* coarsening) {
    PieceToMeasure toGrow;
    int ghostLayers = ghosts;
    comm_.together(kNoun, [&] {
      toGrow = {piece, measuring::partMeasuredBy(piece.cutMesh, whole_.surface)};
      if (coarsening) ghostLayers = coarsen(*coarsening, piece.layers, ghosts);
    });
    ghostLayers = comm_.reduce(ghostLayers, MPI_MAX);
    PieceToMeasure toMeasure = withGhostLayers(comm_, layers_, whole_.common, std::move(toGrow), ghostLayers);
    RankPiece& grown = toMeasure.piece;
    result_.layers = piece.layers;
    result_.allLayers = grown.layers;
    result_.vertexIds = std::move(grown.vertexIds);
    result_.faceIds = std::move(grown.faceIds);
    result_.cellIds = std::move(grown.cellIds);
    result_.cutMesh = std::move(grown.cutMesh);
    comm_.together(kNoun, [&] {
      makeCells(toMeasure.surface);
      result_.seams = seamsOf(result_.cells, result_.cellRanks, comm_.rank());
    });
    numberCorners();
    return std::move(result_);
  }

 private:
  /// Gives how many layers have so many rings of ghosts. Grid cells as they are need no octree.
  int coarsen(const CoarsenOptions& options, const std::array<int64_t, 2>& own, int rings) {
    if (operators::meantFor(whole_.common.grid, options).maxLevel == 0) return rings;
    octree_ = operators::coarsenRuns(whole_.common, options);
    if (own[0] == own[1]) return rings;
    const std::array<int64_t, 2> all = layersAround(*octree_, own, rings);
    return std::max(rings, int(std::max(own[0] - all[0], all[1] - own[1])));
  }

  bool isEmpty() const { return result_.layers[0] == result_.layers[1]; }

  void makeCells(const MeshPart& surface) {
    const UntouchedOrder order = octree_ ? octreeOrder(*octree_, result_.allLayers) : untouchedOrder(whole_.common, result_.allLayers);
    octree_.reset();
    result_.wholeCutCells = whole_.counts.cutCells;
    result_.wholeFaces = whole_.counts.faces + order.all.faces;
    result_.wholeCells = whole_.counts.cutCells + order.all.cells;
    if (isEmpty()) return;
    const RunOptions oneThread{1, {}};
    Measures measures = measuring::measureBy(surface, result_.cutMesh, oneThread);
    result_.cells = operators::cellComplexInLayers(std::move(measures), result_.cutMesh, order.cells, result_.allLayers, oneThread);
    for (const UntouchedCounts& before : order.before) result_.cellIds.push_back(whole_.counts.cutCells + before.cells);
    numberFaces(order);
    std::vector<int32_t> rankOfLayer;
    for (size_t rank = 0; rank < layers_.size(); ++rank)
      rankOfLayer.resize(rankOfLayer.size() + size_t(layers_[rank][1] - layers_[rank][0]), int32_t(rank));
    for (size_t c = 0; c < result_.cells.cellCount(); ++c)
      result_.cellRanks.push_back(rankOfLayer[size_t(result_.cells.cellCorner[3 * c + 2])]);
  }

  /// Those between untouched cells and at the sides of the grid, which follow each other cell by cell.
  void numberFaces(const UntouchedOrder& order) {
    const CellComplex& cells = result_.cells;
    size_t last = cells.cellCount();
    uint64_t next = 0;
    for (size_t f = cells.cutFaces; f < cells.faceCount(); ++f) {
      const size_t owner = ownerOf(f);
      if (owner != last) next = whole_.counts.faces + order.before[owner - cells.cutCells].faces;
      last = owner;
      const int32_t* sides = &cells.faceCells[2 * f];
      if (cells.faceTag[f] == FaceTag::inner && (sides[0] < 0 || sides[1] < 0)) {
        result_.faceIds.push_back(RankComplex::kNoId);
        if (sides[0] < 0 && !order.hasLower.empty()) next += order.hasLower[owner - cells.cutCells];
        continue;
      }
      result_.faceIds.push_back(next++);
    }
  }

  /// The cell whose side a face is: the smaller one, or the first.
  size_t ownerOf(size_t face) const {
    const CellComplex& cells = result_.cells;
    const int32_t a = cells.faceCells[2 * face], b = cells.faceCells[2 * face + 1];
    if (a < 0 || b < 0) return size_t(std::max(a, b));
    return size_t(cells.cellLevel[size_t(b)] < cells.cellLevel[size_t(a)] ? b : a);
  }

  /// Which plane of the grid along z a corner of grid cells lies in.
  size_t planeOf(size_t vertex) const {
    const std::vector<double>& planes = result_.cutMesh.grid.planes[2];
    return size_t(std::lower_bound(planes.begin(), planes.end(), result_.cells.positions[3 * vertex + 2]) - planes.begin());
  }

  /// Corners of untouched cells follow the cut-vertices of the whole, plane by plane along z; each plane is counted by the process below.
  void numberCorners() {
    const CellComplex& cells = result_.cells;
    std::vector<uint64_t> first;
    comm_.together(kNoun, [&] {
      first.assign(whole_.common.grid.planes[2].size() + 1, 0);
      result_.vertexIds.reserve(cells.vertexCount());
    });
    for (size_t v = cells.cutVertices; v < cells.vertexCount(); ++v) {
      const size_t plane = planeOf(v);
      const int64_t layer = std::max<int64_t>(int64_t(plane) - 1, 0);
      if (layer >= result_.layers[0] && layer < result_.layers[1]) ++first[plane + 1];
    }
    comm_.reduce(first, MPI_SUM);
    first[0] = whole_.counts.vertices;
    for (size_t plane = 1; plane < first.size(); ++plane) first[plane] += first[plane - 1];
    result_.wholeVertices = first.back();
    const size_t low = size_t(result_.allLayers[0]), high = size_t(result_.allLayers[1]);
    for (size_t v = cells.cutVertices; v < cells.vertexCount(); ++v) {
      const size_t plane = planeOf(v);
      const bool isFar = (plane <= low && low > 0) || (plane >= high && high + 2 < first.size());
      result_.vertexIds.push_back(isFar ? RankComplex::kNoId : first[plane]++);
    }
  }

  Communicator& comm_;
  const WholeCut& whole_;
  const RankLayers layers_;
  std::optional<OctreeCells> octree_;  // of the whole, until the cells here are found
  RankComplex result_;
};

}  // namespace

std::vector<ComplexSeam> seamsOf(const CellComplex& cells, const std::vector<int32_t>& cellRanks, int rank) {
  std::vector<ComplexSeam> seams;
  for (uint32_t f = 0; f < cells.faceCount(); ++f) {
    const int32_t a = cells.faceCells[2 * size_t(f)], b = cells.faceCells[2 * size_t(f) + 1];
    if (a < 0 || b < 0) continue;
    const int32_t ranks[] = {cellRanks[size_t(a)], cellRanks[size_t(b)]};
    if (ranks[0] == ranks[1] || (ranks[0] != rank && ranks[1] != rank)) continue;
    const int other = ranks[0] == rank ? ranks[1] : ranks[0];
    const auto at = std::find_if(seams.begin(), seams.end(), [&](const ComplexSeam& seam) { return seam.rank >= other; });
    const auto seam = at != seams.end() && at->rank == other ? at : seams.insert(at, {other, {}});
    seam->faces.push_back(f);
  }
  return seams;
}

RankComplex makeRankComplex(Communicator& comm, const WholeCut& whole, const RankPiece& piece, int ghosts,
                            const CoarsenOptions* coarsening) {
  comm.together(kNoun, [&] {
    if (ghosts < 1) throw CallError({Status::badOption, -1, -1, "A cell complex in pieces needs a layer of ghosts."});
  });
  return ComplexMaker(comm, whole, layersOfAll(comm, piece.layers)).make(piece, ghosts, coarsening);
}

}  // namespace mandoline::detail
