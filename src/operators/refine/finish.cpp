#include "operators/refine/finish.h"

#include <algorithm>

#include "operators/cell_complex/half_faces.h"
#include "operators/refine/regions.h"

namespace mandoline::refining {
namespace {

class Finisher {
 public:
  Finisher(Assembled assembled, const Sources& sources, Grid grid) : from_(std::move(assembled)), sources_(sources) {
    cutMesh_.grid = std::move(grid);
  }

  RefinedCells run() {
    takeCells();
    takeFaces();
    takeRegions();
    takeVertices();
    takeLoops();
    operators::gatherHalfFaces(cells_);
    fillCutMesh();
    RefinedCells result;
    result.cells = std::move(cells_);
    result.cutMesh = std::move(cutMesh_);
    return result;
  }

 private:
  static constexpr uint32_t kNone = ~0u;
  double plane(size_t axis, int32_t index) const { return cutMesh_.grid.planes[axis][size_t(index)]; }
  /// Moves items, so that there is memory for them once.
  template <class Item>
  static void append(std::vector<Item>& from, std::vector<Item>& to) {
    if (to.empty()) {
      to = std::move(from);
    } else {
      to.insert(to.end(), from.begin(), from.end());
    }
    from = {};
  }
  template <class Item>
  static void appendShifted(const std::vector<Item>& from, std::vector<Item>& to) {
    const Item shift = to.back();
    for (size_t i = 1; i < from.size(); ++i) to.push_back(from[i] + shift);
  }

  /// Those of cut-faces first.
  void takeVertices() {
    numbers_.assign(sources_.ids.size(), kNone);
    std::vector<uint32_t> used;
    for (FaceList* list : {&from_.cut, &from_.plain}) {
      for (uint32_t& v : list->loopVertices) {
        if (numbers_[v] == kNone) numbers_[v] = uint32_t(used.size()), used.push_back(v);
        v = numbers_[v];
      }
      if (list == &from_.cut) cells_.cutVertices = uint32_t(used.size());
    }
    for (const uint32_t id : used) addVertex(sources_.ids.sourceOf(id));
  }

  void addVertex(const SharedIds::Source& source) {
    const bool isCut = cells_.positions.size() < 3 * size_t(cells_.cutVertices);
    double position[3];
    int32_t cell[3], parents[2] = {-1, -1}, triVertex = -1;
    uint8_t mask = 7;
    for (size_t d = 0; d < 3; ++d) position[d] = plane(d, cell[d] = source.part == kNone ? source.at[d] : 0);
    if (source.part != kNone) {
      const Part& part = sources_.parts[source.part];
      const CutMesh& cutMesh = part.cutMesh();
      const size_t v = source.vertex;
      mask = cutMesh.vertexMask[v];
      triVertex = cutMesh.vertexTriVertex[v];
      if (triVertex >= 0) triVertex = int32_t(part.triVertex(triVertex));
      takeParents(part, v, parents);
      for (size_t d = 0; d < 3; ++d) {
        position[d] = cutMesh.positions[3 * v + d];
        const int32_t low = (cutMesh.vertexCell[3 * v + d] + part.first[d]) << part.level;
        cell[d] = mask >> d & 1 ? low : slabOf(d, position[d], low, low + (1 << part.level));
      }
    }
    cells_.positions.insert(cells_.positions.end(), position, position + 3);
    if (!isCut) return;
    cutMesh_.vertexCell.insert(cutMesh_.vertexCell.end(), cell, cell + 3);
    cutMesh_.vertexMask.push_back(mask);
    cutMesh_.vertexTriVertex.push_back(triVertex);
    cutMesh_.vertexParents.insert(cutMesh_.vertexParents.end(), parents, parents + 2);
  }

  int32_t slabOf(size_t axis, double x, int32_t low, int32_t past) const {
    const auto first = cutMesh_.grid.planes[axis].begin();
    return std::clamp(int32_t(std::upper_bound(first + low, first + past, x) - first) - 1, low, past - 1);
  }

  static void takeParents(const Part& part, size_t v, int32_t* parents) {
    const int32_t* from = &part.cutMesh().vertexParents[2 * v];
    if (from[1] >= 0) {
      for (size_t i = 0; i < 2; ++i) parents[i] = int32_t(part.triVertex(from[i]));
    } else if (from[0] >= 0) {
      parents[0] = int32_t(part.triangle(from[0]));
    }
  }

  void takeCells() {
    cells_.cutCells = from_.cutCells;
    for (const bool cut : {true, false}) {
      for (size_t leaf = 0; leaf < sources_.leaves.cellCount(); ++leaf) {
        const BlockCells& block = from_.leafCells[leaf];
        if (block.isCut() != cut) continue;
        for (size_t i = 0; i < std::max<size_t>(block.cells.size(), 1); ++i) addCell(leaf, block.cells.begin + i);
      }
    }
  }

  void addCell(size_t leaf, size_t cutCell) {
    const Block corner = sources_.leaves.corner(leaf), end = sources_.leaves.end(leaf);
    const BlockCells& block = from_.leafCells[leaf];
    double volume = 1;
    for (size_t d = 0; d < 3; ++d) {
      const double middle = plane(d, corner[d]) / 2 + plane(d, end[d]) / 2;
      volume *= plane(d, end[d]) - plane(d, corner[d]);
      cells_.cellCorner.push_back(corner[d]);
      cells_.cellCentre.push_back(middle);
      cells_.cellCentroid.push_back(block.isCut() ? block.part->measures.cellCentroid[3 * cutCell + d] : middle);
    }
    cells_.cellVolume.push_back(block.isCut() ? block.part->measures.cellVolume[cutCell] : volume);
    cells_.cellLevel.push_back(sources_.leaves.cellLevel[leaf]);
  }

  void takeFaces() {
    cells_.cutFaces = from_.cut.size();
    for (FaceList* list : {&from_.cut, &from_.plain}) {
      append(list->faceCells, cells_.faceCells);
      append(list->faceTag, cells_.faceTag);
      append(list->faceArea, cells_.faceArea);
      append(list->faceNormal, cells_.faceNormal);
      append(list->faceCentroid, cells_.faceCentroid);
    }
  }

  void takeLoops() {
    cells_.loopOffsets = cells_.faceLoopOffsets = {0};
    for (const FaceList* list : {&from_.cut, &from_.plain}) {
      cells_.loopVertices.insert(cells_.loopVertices.end(), list->loopVertices.begin(), list->loopVertices.end());
      appendShifted(list->loopOffsets, cells_.loopOffsets);
      appendShifted(list->faceLoopOffsets, cells_.faceLoopOffsets);
    }
  }

  void takeRegions() {
    const CutMesh& whole = sources_.whole;
    cells_.cellRegion = findRegions(cells_, from_, sources_);
    cutMesh_.regionCount = whole.regionCount;
    cutMesh_.hasWinding = whole.hasWinding;
    cutMesh_.regionWinding = whole.regionWinding;
    cutMesh_.regionPartWinding = whole.regionPartWinding;
    cutMesh_.regionParity = whole.regionParity;
  }

  void fillCutMesh() {
    FaceList& cut = from_.cut;
    CutMesh& to = cutMesh_;
    to.positions.assign(cells_.positions.begin(), cells_.positions.begin() + std::ptrdiff_t(3 * size_t(cells_.cutVertices)));
    to.loopOffsets = std::move(cut.loopOffsets);
    to.loopVertices = std::move(cut.loopVertices);
    to.faceLoopOffsets = std::move(cut.faceLoopOffsets);
    to.faceTriangle = std::move(cut.faceTriangle);
    to.faceParentOffsets = std::move(cut.faceParentOffsets);
    to.faceParents = std::move(cut.faceParents);
    to.faceParentSigns = std::move(cut.faceParentSigns);
    to.faceAxis = std::move(cut.faceAxis);
    to.facePlane = std::move(cut.facePlane);
    const size_t n = cells_.cutCells;
    const auto begin = cells_.cellHalfFaceOffsets.begin();
    to.cellHalfFaceOffsets.assign(begin, begin + std::ptrdiff_t(n + 1));
    to.cellHalfFaces.assign(cells_.cellHalfFaces.begin(), cells_.cellHalfFaces.begin() + std::ptrdiff_t(to.cellHalfFaceOffsets.back()));
    to.cellGridCell.assign(cells_.cellCorner.begin(), cells_.cellCorner.begin() + std::ptrdiff_t(3 * n));
    to.cellRegion.assign(cells_.cellRegion.begin(), cells_.cellRegion.begin() + std::ptrdiff_t(n));
    to.triangleCount = sources_.whole.triangleCount;
    to.droppedTriangles = sources_.whole.droppedTriangles;
    to.parityTriangles = sources_.whole.parityTriangles;
    to.openTriangles = sources_.whole.openTriangles;
    to.madeFrom = sources_.whole.madeFrom;
  }

  Assembled from_;
  const Sources& sources_;
  std::vector<uint32_t> numbers_;  // per id
  CellComplex cells_;
  CutMesh cutMesh_;
};

}  // namespace

RefinedCells finish(Assembled assembled, const Sources& sources, Grid grid) {
  return Finisher(std::move(assembled), sources, std::move(grid)).run();
}

}  // namespace mandoline::refining
