#include "mpi/make_rank_complex.h"

#include <algorithm>

#include "mpi/communicator.h"
#include "mpi/ghost_layers.h"
#include "mpi/untouched_order.h"
#include "operators/cell_complex/in_layers.h"
#include "operators/measure/measure_part.h"

namespace mandoline::detail {
namespace {

constexpr const char* kNoun = "assembly of the cells";

class ComplexMaker {
 public:
  ComplexMaker(Communicator& comm, const WholeCut& whole, RankLayers layers) : comm_(comm), whole_(whole), layers_(std::move(layers)) {}

  RankComplex make(const RankPiece& piece, int ghostLayers) {
    PieceToMeasure toGrow;
    comm_.together(kNoun, [&] { toGrow = {piece, measuring::partMeasuredBy(piece.cutMesh, whole_.surface)}; });
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
      findSeams();
    });
    numberCorners();
    return std::move(result_);
  }

 private:
  bool isEmpty() const { return result_.layers[0] == result_.layers[1]; }

  void makeCells(const MeshPart& surface) {
    const UntouchedOrder order = untouchedOrder(whole_.common, result_.allLayers);
    result_.wholeCutCells = whole_.counts.cutCells;
    result_.wholeFaces = whole_.counts.faces + order.all.faces();
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
      const int32_t *sides = &cells.faceCells[2 * f], owner = sides[0] < 0 ? sides[1] : sides[0];
      if (cells.faceTag[f] == FaceTag::inner && (sides[0] < 0 || sides[1] < 0)) {
        result_.faceIds.push_back(RankComplex::kNoId);
        continue;
      }
      if (size_t(owner) != last) next = whole_.counts.faces + order.before[size_t(owner) - cells.cutCells].faces();
      last = size_t(owner);
      result_.faceIds.push_back(next++);
    }
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
      const bool isFar = (plane == low && low > 0) || (plane == high && high + 2 < first.size());
      result_.vertexIds.push_back(isFar ? RankComplex::kNoId : first[plane]++);
    }
  }

  void findSeams() {
    const CellComplex& cells = result_.cells;
    for (uint32_t f = 0; f < cells.faceCount(); ++f) {
      const int32_t a = cells.faceCells[2 * size_t(f)], b = cells.faceCells[2 * size_t(f) + 1];
      if (a < 0 || b < 0) continue;
      const int32_t ranks[] = {result_.cellRanks[size_t(a)], result_.cellRanks[size_t(b)]};
      if (ranks[0] == ranks[1] || (ranks[0] != comm_.rank() && ranks[1] != comm_.rank())) continue;
      const int other = ranks[0] == comm_.rank() ? ranks[1] : ranks[0];
      std::vector<ComplexSeam>& seams = result_.seams;
      const auto at = std::find_if(seams.begin(), seams.end(), [&](const ComplexSeam& seam) { return seam.rank >= other; });
      const auto seam = at != seams.end() && at->rank == other ? at : seams.insert(at, {other, {}});
      seam->faces.push_back(f);
    }
  }

  Communicator& comm_;
  const WholeCut& whole_;
  const RankLayers layers_;
  RankComplex result_;
};

}  // namespace

RankComplex makeRankComplex(Communicator& comm, const WholeCut& whole, const RankPiece& piece, int ghostLayers) {
  comm.together(kNoun, [&] {
    if (ghostLayers < 1) throw CallError({Status::badOption, -1, -1, "A cell complex in pieces needs a layer of ghosts."});
  });
  return ComplexMaker(comm, whole, layersOfAll(comm, piece.layers)).make(piece, ghostLayers);
}

}  // namespace mandoline::detail
