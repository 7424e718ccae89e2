#include "mpi/rank_piece.h"

#include <algorithm>

#include "cut/append.h"
#include "mesh/failure.h"
#include "mesh/fingerprints.h"

namespace mandoline::detail {
namespace {

constexpr uint32_t kNone = ~0u;

[[noreturn]] void failUnknown(const char* what, uint64_t id) {
  throw Failure{{Status::internalError, int64_t(id), -1, std::string("No process has ") + what + " " + std::to_string(id) + "."}};
}

std::optional<uint32_t> find(const std::vector<uint64_t>& ids, uint64_t id) {
  const auto found = std::lower_bound(ids.begin(), ids.end(), id);
  if (found == ids.end() || *found != id) return {};
  return uint32_t(found - ids.begin());
}

/// Per face of a part the cut-cell of the part that has it; of two the second.
std::vector<uint32_t> cellsOfFaces(const NumberedPart& numbered) {
  std::vector<uint32_t> cells(numbered.part.cutMesh.faceCount(), kNone);
  for (uint32_t c = 0; c < numbered.part.cutMesh.cellCount(); ++c) {
    for (const uint32_t h : numbered.part.cutMesh.halfFaces(c)) {
      if (const auto f = numbered.findFace(h / 2)) cells[*f] = c;
    }
  }
  return cells;
}

/// The untouched cells of the layers.
void takeRuns(const CutMesh& common, const std::array<int64_t, 2>& layers, CutMesh& out) {
  const size_t ny = size_t(common.grid.cells(1)), first = size_t(layers[0]) * ny, past = size_t(layers[1]) * ny;
  const uint32_t begin = common.rowRunOffsets[first], end = common.rowRunOffsets[past];
  const auto take = [&](auto array) { (out.*array).assign((common.*array).begin() + begin, (common.*array).begin() + end); };
  take(&CutMesh::runBegin);
  take(&CutMesh::runEnd);
  take(&CutMesh::runRegion);
  out.rowRunOffsets.reserve(common.rowRunOffsets.size());
  for (const uint32_t offset : common.rowRunOffsets) out.rowRunOffsets.push_back(std::clamp(offset, begin, end) - begin);
}

/// The made vertices among those of the piece.
void takeMade(const CutMesh& common, RankPiece& piece) {
  const std::vector<uint64_t>& ids = piece.vertexIds;
  uint32_t v = 0;
  for (size_t i = 0; i < common.madeVertices.size(); ++i) {
    while (v < ids.size() && ids[v] < common.madeVertices[i]) ++v;
    if (v < ids.size() && ids[v] == common.madeVertices[i]) appendMade(common, i, v, piece.cutMesh);
  }
}

class PieceMaker {
 public:
  PieceMaker(const NumberedPart& numbered, const CutMesh& common, const PlaneFaces& below)
      : numbered_(numbered), part_(numbered.part.cutMesh), common_(common), below_(below) {}

  PieceFromBelow make(const std::array<int64_t, 2>& layers) {
    made_.piece.layers = layers;
    findGhostFaces();
    takeFaces();
    takeVertices();
    takeCells();
    takeCommon(common_, made_.piece);
    return std::move(made_);
  }

 private:
  CutMesh& out() { return made_.piece.cutMesh; }

  /// Those that cells here have, and which cells.
  void findGhostFaces() {
    ghostCells_.assign(below_.faceIds.size(), kNone);
    for (uint32_t c = 0; c < part_.cellCount(); ++c) {
      for (const uint32_t h : part_.halfFaces(c)) {
        if (numbered_.findFace(h / 2)) continue;
        const auto ghost = find(below_.faceIds, h / 2);
        if (!ghost) failUnknown("face", h / 2);
        ghostCells_[*ghost] = c;
      }
    }
  }

  /// Tri-cut-faces, then pieces of grid-faces; of both the ghosts first, which come from lower layers.
  void takeFaces() {
    beginFaces(out());
    newFaces_.resize(part_.faceCount());
    newGhosts_.resize(below_.faceIds.size());
    const uint32_t triFaces = numbered_.part.triFaces;
    reserveFaces({&part_, &below_.cutMesh}, out());
    made_.piece.faceIds.reserve(newFaces_.size() + newGhosts_.size());
    made_.piece.faceRanks.reserve(newFaces_.size() + newGhosts_.size());
    uint32_t ghost = 0;
    const auto takeGhosts = [&](bool ofTriangles) {
      for (; ghost < below_.faceIds.size() && (below_.cutMesh.faceTriangle[ghost] >= 0) == ofTriangles; ++ghost) {
        if (ghostCells_[ghost] != kNone) takeGhost(ghost);
      }
    };
    takeGhosts(true);
    for (uint32_t f = 0; f < triFaces; ++f) takeOwn(f);
    takeGhosts(false);
    for (uint32_t f = triFaces; f < part_.faceCount(); ++f) takeOwn(f);
  }
  void takeOwn(uint32_t f) {
    newFaces_[f] = uint32_t(out().faceCount());
    appendFace(part_, f, out());
    note(numbered_.faceId(f), numbered_.rank);
  }
  void takeGhost(uint32_t f) {
    newGhosts_[f] = uint32_t(out().faceCount());
    appendFace(below_.cutMesh, f, out());
    note(below_.faceIds[f], below_.rank);
    if (below_.cells[f] == PlaneFaces::kNoCell) return;
    made_.forBelow.rank = numbered_.rank;
    made_.forBelow.faceIds.push_back(below_.faceIds[f]);
    made_.forBelow.cells.push_back(numbered_.firstCell + ghostCells_[f]);
    std::vector<RankSeam>& seams = made_.piece.seams;
    if (seams.empty()) seams.push_back({below_.rank, {}, {}});
    seams.back().faces.push_back(newGhosts_[f]);
    seams.back().cells.push_back(below_.cells[f]);
  }
  void note(uint64_t faceId, int rank) {
    made_.piece.faceIds.push_back(faceId);
    made_.piece.faceRanks.push_back(rank);
  }

  /// Those of the mesh and its edges by number, then ghosts of the others, which come from lower layers, then the part's own others.
  void takeVertices() {
    const size_t ownFirst = numbered_.part.firstVertices.size(), own = part_.vertexCount();
    std::vector<uint32_t> ofSurface(numbered_.surfaceVertices, kNone), others(own - ownFirst, kNone);
    std::vector<uint32_t> ghosts(below_.vertexIds.size(), kNone);
    const auto ghostOf = [&](uint64_t id) {
      const auto ghost = find(below_.vertexIds, id);
      if (!ghost) failUnknown("vertex", id);
      return *ghost;
    };
    const auto placeOf = [&](uint64_t id) -> uint32_t& {
      if (id < numbered_.surfaceVertices) return ofSurface[id];
      if (id >= numbered_.firstVertex && id - numbered_.firstVertex < others.size()) return others[id - numbered_.firstVertex];
      return ghosts[ghostOf(id)];
    };
    for (const uint32_t v : out().loopVertices) placeOf(v) = 0;
    reserveVertices({&part_, &below_.cutMesh}, out());
    made_.piece.vertexIds.reserve(own + ghosts.size());
    made_.piece.vertexRanks.reserve(own + ghosts.size());
    std::vector<uint32_t> ownOfSurface(numbered_.surfaceVertices, kNone);
    for (uint32_t v = 0; v < ownFirst; ++v) {
      if (numbered_.part.firstVertices[v] != kNone) ownOfSurface[numbered_.part.firstVertices[v]] = v;
    }
    for (uint64_t id = 0; id < ofSurface.size(); ++id) {
      if (ofSurface[id] == kNone) continue;
      ofSurface[id] = uint32_t(out().vertexCount());
      if (ownOfSurface[id] != kNone)
        takeVertex(part_, ownOfSurface[id], id, numbered_.rank);
      else
        takeGhostVertex(ghostOf(id));
    }
    for (uint32_t v = 0; v < ghosts.size(); ++v) {
      if (ghosts[v] == kNone) continue;
      ghosts[v] = uint32_t(out().vertexCount());
      takeGhostVertex(v);
    }
    for (uint32_t v = 0; v < others.size(); ++v) {
      if (others[v] == kNone) continue;
      others[v] = uint32_t(out().vertexCount());
      takeVertex(part_, ownFirst + v, numbered_.firstVertex + v, numbered_.rank);
    }
    for (uint32_t& v : out().loopVertices) v = placeOf(v);
  }
  void takeGhostVertex(uint32_t v) { takeVertex(below_.cutMesh, v, below_.vertexIds[v], below_.isUsed[v] ? below_.rank : numbered_.rank); }
  void takeVertex(const CutMesh& from, size_t v, uint64_t id, int rank) {
    appendVertex(from, v, out());
    made_.piece.vertexIds.push_back(id);
    made_.piece.vertexRanks.push_back(rank);
  }

  void takeCells() {
    out().cellGridCell = part_.cellGridCell;
    out().cellRegion = part_.cellRegion;
    out().cellHalfFaceOffsets = part_.cellHalfFaceOffsets;
    out().cellHalfFaces.reserve(part_.cellHalfFaces.size());
    for (const uint32_t h : part_.cellHalfFaces) {
      const auto own = numbered_.findFace(h / 2);
      out().cellHalfFaces.push_back(2 * (own ? newFaces_[*own] : newGhosts_[*find(below_.faceIds, h / 2)]) + h % 2);
    }
    for (uint64_t c = 0; c < part_.cellCount(); ++c) made_.piece.cellIds.push_back(numbered_.firstCell + c);
  }

  const NumberedPart& numbered_;
  const CutMesh& part_;
  const CutMesh& common_;
  const PlaneFaces& below_;
  PieceFromBelow made_;
  std::vector<uint32_t> ghostCells_;            // per face from below: the cut-cell of the part that has it
  std::vector<uint32_t> newFaces_, newGhosts_;  // per face of the part, and from below: that of the piece
};

}  // namespace

std::optional<uint32_t> NumberedPart::findFace(uint64_t id) const {
  if (id >= firstTriFace && id - firstTriFace < part.triFaces) return uint32_t(id - firstTriFace);
  if (id >= firstPiece && id - firstPiece < part.cutMesh.faceCount() - part.triFaces) return uint32_t(id - firstPiece) + part.triFaces;
  return {};
}

PlaneFaces facesInPlane(const NumberedPart& numbered, int32_t plane) {
  const CutMesh& part = numbered.part.cutMesh;
  PlaneFaces found;
  found.rank = numbered.rank;
  beginFaces(found.cutMesh);
  const std::vector<uint32_t> cells = cellsOfFaces(numbered);
  for (size_t f = 0; f < part.faceCount(); ++f) {
    if (part.faceAxis[f] != 2 || part.facePlane[f] != plane) continue;
    appendFace(part, f, found.cutMesh);
    found.faceIds.push_back(numbered.faceId(f));
    found.cells.push_back(cells[f] == kNone ? PlaneFaces::kNoCell : numbered.firstCell + cells[f]);
  }
  std::vector<uint8_t> isSurfaceUsed(numbered.surfaceVertices, 0);
  for (const uint32_t v : part.loopVertices) {
    if (v < numbered.surfaceVertices) isSurfaceUsed[v] = 1;
  }
  for (size_t v = 0; v < part.vertexCount(); ++v) {
    const bool isIn = (part.vertexMask[v] & 4) != 0 && part.vertexCell[3 * v + 2] == plane;
    const bool isOthers = v < numbered.part.firstVertices.size() && numbered.part.firstVertices[v] == kNone;
    if (!isIn || isOthers) continue;
    appendVertex(part, v, found.cutMesh);
    const uint64_t id = numbered.vertexId(v);
    found.vertexIds.push_back(id);
    found.isUsed.push_back(id >= numbered.surfaceVertices || isSurfaceUsed[id]);
  }
  return found;
}

void takeCommon(const CutMesh& common, RankPiece& piece) {
  CutMesh& out = piece.cutMesh;
  copyCommon(common, out);
  takeRuns(common, piece.layers, out);
  listWithoutFace(out);
  piece.whole = common.fingerprint;
  Fingerprinter fingerprinter("piece", piece.whole);
  for (const int64_t layer : piece.layers) fingerprinter.add(uint64_t(layer));
  out.fingerprint = fingerprinter.get();
  takeMade(common, piece);
}

PieceFromBelow makePiece(const NumberedPart& numbered, const CutMesh& common, const std::array<int64_t, 2>& layers,
                         const PlaneFaces& below) {
  return PieceMaker(numbered, common, below).make(layers);
}

void addSeam(const CellsAbove& above, RankPiece& piece) {
  if (above.faceIds.empty()) return;
  RankSeam& seam = piece.seams.emplace_back();
  seam.rank = above.rank;
  seam.cells = above.cells;
  for (const uint64_t id : above.faceIds) seam.faces.push_back(*find(piece.faceIds, id));
}

}  // namespace mandoline::detail
