#include "compare_complex.h"

#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "ranks_here.h"
#include "same_bits.h"

using namespace mandoline;

namespace {

constexpr uint64_t kNoId = RankComplex::kNoId;

void require(bool holds, const std::string& what, size_t element = 0) {
  if (!holds) throw std::runtime_error(what + " " + std::to_string(element));
}

template <class Number>
void requireSame(const std::vector<Number>& a, size_t i, const std::vector<Number>& b, size_t j, size_t items, const char* what) {
  require(bytesOf(a.data() + i * items, items) == bytesOf(b.data() + j * items, items), std::string(what) + " differs at", j);
}

bool isMine(const RankComplex& mine, int32_t cell) {
  if (cell < 0) return false;
  const int32_t layer = mine.cells.cellCorner[3 * size_t(cell) + 2];
  return layer >= mine.layers[0] && layer < mine.layers[1];
}

void compareCells(const RankComplex& mine, const CellComplex& whole) {
  const CellComplex& cells = mine.cells;
  const bool hasLayers = mine.layers[0] < mine.layers[1];
  size_t expected = 0;
  for (size_t c = 0; c < whole.cellCount(); ++c) {
    const int64_t layer = whole.cellCorner[3 * c + 2];
    expected += hasLayers && layer + (1 << whole.cellLevel[c]) > mine.allLayers[0] && layer < mine.allLayers[1];
  }
  require(cells.cellCount() == expected && mine.cellIds.size() == expected && mine.cellRanks.size() == expected, "cells are missing");
  for (size_t c = 0; c < cells.cellCount(); ++c) {
    const size_t id = mine.cellIds[c];
    require(id < whole.cellCount() && (c == 0 || mine.cellIds[c - 1] < id), "cell ids do not ascend at", id);
    requireSame(cells.cellCorner, c, whole.cellCorner, id, 3, "cellCorner");
    requireSame(cells.cellCentre, c, whole.cellCentre, id, 3, "cellCentre");
    requireSame(cells.cellCentroid, c, whole.cellCentroid, id, 3, "cellCentroid");
    requireSame(cells.cellVolume, c, whole.cellVolume, id, 1, "cellVolume");
    requireSame(cells.cellRegion, c, whole.cellRegion, id, 1, "cellRegion");
    requireSame(cells.cellLevel, c, whole.cellLevel, id, 1, "cellLevel");
    require((c < cells.cutCells) == (id < whole.cutCells), "a cut-cell differs:", id);
    if (!isMine(mine, int32_t(c))) continue;
    const auto here = cells.halfFaces(c), there = whole.halfFaces(id);
    require(here.size() == there.size(), "half-faces differ of cell", id);
    for (size_t i = 0; i < here.size(); ++i)
      require(2 * mine.faceIds[here[i] / 2] + here[i] % 2 == there[i], "half-faces differ of cell", id);
  }
}

void compareFace(const RankComplex& mine, const CellComplex& whole, size_t f) {
  const CellComplex& cells = mine.cells;
  const size_t id = mine.faceIds[f];
  require(id < whole.faceCount(), "a face has no id:", f);
  requireSame(cells.faceArea, f, whole.faceArea, id, 1, "faceArea");
  requireSame(cells.faceNormal, f, whole.faceNormal, id, 3, "faceNormal");
  requireSame(cells.faceCentroid, f, whole.faceCentroid, id, 3, "faceCentroid");
  require(cells.faceTag[f] == whole.faceTag[id], "faceTag differs at", id);
  for (size_t side = 0; side < 2; ++side) {
    const int32_t here = cells.faceCells[2 * f + side], there = whole.faceCells[2 * id + side];
    require((here < 0 ? -1 : int64_t(mine.cellIds[size_t(here)])) == there, "faceCells differ at", id);
  }
  require(cells.loops(f).size() == whole.loops(id).size(), "loops differ of face", id);
  for (size_t l = 0; l < cells.loops(f).size(); ++l) {
    const auto here = cells.loops(f)[l], there = whole.loops(id)[l];
    require(here.size() == there.size(), "loops differ of face", id);
    for (size_t i = 0; i < here.size(); ++i) {
      require(mine.vertexIds[here[i]] == there[i], "loops differ of face", id);
      requireSame(cells.positions, here[i], whole.positions, there[i], 3, "positions");
    }
  }
}

void compareFaces(const RankComplex& mine, const CellComplex& whole) {
  require(mine.faceIds.size() == mine.cells.faceCount() && mine.vertexIds.size() == mine.cells.vertexCount(), "ids are missing");
  uint64_t last = 0;
  for (size_t f = 0; f < mine.cells.faceCount(); ++f) {
    if (mine.faceIds[f] != kNoId) require(f == 0 || mine.faceIds[f] > last || last == 0, "face ids do not ascend at", f);
    if (mine.faceIds[f] != kNoId) {
      last = mine.faceIds[f];
      require(last < whole.faceCount(), "the whole has no face", last);
      requireSame(mine.cells.faceCentroid, f, whole.faceCentroid, last, 3, "faceCentroid");
    }
    if (isMine(mine, mine.cells.faceCells[2 * f]) || isMine(mine, mine.cells.faceCells[2 * f + 1])) compareFace(mine, whole, f);
  }
  for (size_t v = mine.cells.cutVertices; v < mine.cells.vertexCount(); ++v) {
    if (mine.vertexIds[v] != kNoId) requireSame(mine.cells.positions, v, whole.positions, mine.vertexIds[v], 3, "positions");
  }
}

/// By other process, the ids of faces, as both processes have to list them.
void compareSeams(const RankComplex& mine) {
  const int rank = rankHere(), size = ranksHere();
  std::vector<std::vector<uint64_t>> lists(static_cast<size_t>(size));
  for (const ComplexSeam& seam : mine.seams) {
    for (const uint32_t f : seam.faces) lists[size_t(seam.rank)].push_back(mine.faceIds[f]);
  }
  std::string problem;
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < a; ++b) {
      if (rank != a && rank != b) continue;
      const std::vector<uint64_t>& list = lists[size_t(rank == a ? b : a)];
      uint64_t count = list.size(), others = 0;
      MPI_Sendrecv(&count, 1, MPI_UINT64_T, a + b - rank, 0, &others, 1, MPI_UINT64_T, a + b - rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      std::vector<uint64_t> theirs(others);
      MPI_Sendrecv(list.data(), int(count), MPI_UINT64_T, a + b - rank, 0, theirs.data(), int(others), MPI_UINT64_T, a + b - rank, 0,
                   MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      if (list != theirs) problem = "the seam of processes " + std::to_string(b) + " and " + std::to_string(a) + " differs:";
    }
  }
  require(problem.empty(), problem);
  size_t between = 0, listed = 0;
  for (size_t f = 0; f < mine.cells.faceCount(); ++f) {
    const int32_t a = mine.cells.faceCells[2 * f], b = mine.cells.faceCells[2 * f + 1];
    between += a >= 0 && b >= 0 && isMine(mine, a) != isMine(mine, b);
  }
  for (const auto& list : lists) listed += list.size();
  require(between == listed, "a seam has another number of faces:", listed);
}

}  // namespace

void compareComplex(const RankComplex& mine, const CellComplex& whole) {
  std::string problem;
  try {
    compareCells(mine, whole);
    compareFaces(mine, whole);
    require(mine.wholeVertices == whole.vertexCount(), "the whole has other vertices:", mine.wholeVertices);
    require(mine.wholeFaces == whole.faceCount(), "the whole has other faces:", mine.wholeFaces);
    require(mine.wholeCells == whole.cellCount() && mine.wholeCutCells == whole.cutCells, "the whole has other cells:", mine.wholeCells);
  } catch (const std::runtime_error& error) {
    problem = error.what();
  }
  compareSeams(mine);
  if (!problem.empty()) throw std::runtime_error(problem);
}
