#include "operators/refine/finish.h"

#include <algorithm>

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/refine/face_writer.h"
#include "operators/refine/regions.h"

namespace mandoline::refining {
namespace {

struct Nothing {};

class Finisher {
 public:
  Finisher(Assembled assembled, const Sources& sources, Grid grid, detail::Monitor& monitor)
      : from_(std::move(assembled)), sources_(sources), monitor_(monitor) {
    cutMesh_.grid = std::move(grid);
  }

  RefinedCells run() {
    writeFaces(from_, sources_, monitor_, cells_, cutMesh_);
    from_.levels = {};
    takeCells();
    takeRegions();
    std::vector<uint32_t> ids;
    const std::function<void()> tasks[] = {[&] { operators::gatherHalfFaces(cells_); }, [&] { ids = numberVertices(); }};
    detail::runTasks(tasks, monitor_);
    takeVertices(ids);
    fillCutMesh();
    RefinedCells result;
    result.cells = std::move(cells_);
    result.cutMesh = std::move(cutMesh_);
    return result;
  }

 private:
  static constexpr uint32_t kNone = ~0u;
  double plane(size_t axis, int32_t index) const { return cutMesh_.grid.planes[axis][size_t(index)]; }

  /// Those of cut-faces first. Gives their ids.
  std::vector<uint32_t> numberVertices() {
    std::vector<uint32_t> numbers(sources_.ids.size(), kNone), used;
    const size_t corners = cells_.loopVertices.size(), cutCorners = cells_.loopOffsets[cells_.faceLoopOffsets[cells_.cutFaces]];
    for (size_t i = 0; i < corners; ++i) {
      uint32_t& v = cells_.loopVertices[i];
      if (numbers[v] == kNone) numbers[v] = uint32_t(used.size()), used.push_back(v);
      v = numbers[v];
      if (i + 1 == cutCorners) cells_.cutVertices = uint32_t(used.size());
    }
    return used;
  }

  void takeVertices(const std::vector<uint32_t>& ids) {
    detail::makeLarge(cells_.positions, 3 * ids.size());
    cutMesh_.vertexCell.resize(3 * size_t(cells_.cutVertices));
    cutMesh_.vertexMask.resize(cells_.cutVertices);
    cutMesh_.vertexTriVertex.resize(cells_.cutVertices);
    cutMesh_.vertexParents.resize(2 * size_t(cells_.cutVertices));
    detail::forChunks<Nothing>(ids.size(), monitor_, [&](Nothing&, size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) takeVertex(v, sources_.ids.sourceOf(ids[v]));
    });
  }

  void takeVertex(size_t v, const SharedIds::Source& source) {
    const bool isCut = v < cells_.cutVertices;
    for (size_t d = 0; d < 3; ++d)
      cells_.positions[3 * v + d] =
          source.part == kNone ? plane(d, source.at[d]) : sources_.parts[source.part].cutMesh().positions[3 * size_t(source.vertex) + d];
    if (!isCut) return;
    int32_t *cell = &cutMesh_.vertexCell[3 * v], *parents = &cutMesh_.vertexParents[2 * v];
    std::copy_n(source.at.begin(), 3, cell);
    parents[0] = parents[1] = cutMesh_.vertexTriVertex[v] = -1;
    cutMesh_.vertexMask[v] = 7;
    if (source.part == kNone) return;
    const Part& part = sources_.parts[source.part];
    const CutMesh& from = part.cutMesh();
    const uint8_t mask = cutMesh_.vertexMask[v] = from.vertexMask[source.vertex];
    const int32_t triVertex = from.vertexTriVertex[source.vertex];
    if (triVertex >= 0) cutMesh_.vertexTriVertex[v] = int32_t(part.triVertex(triVertex));
    takeParents(part, source.vertex, parents);
    for (size_t d = 0; d < 3; ++d) {
      const int32_t low = (from.vertexCell[3 * size_t(source.vertex) + d] + part.first[d]) << part.level;
      cell[d] = mask >> d & 1 ? low : slabOf(d, cells_.positions[3 * v + d], low, low + (1 << part.level));
    }
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
    const size_t count = from_.cells;
    cells_.cellCorner.resize(3 * count);
    detail::makeLarge(cells_.cellCentre, 3 * count);
    detail::makeLarge(cells_.cellCentroid, 3 * count);
    detail::makeLarge(cells_.cellVolume, count);
    cells_.cellLevel.resize(count);
    detail::forChunks<Nothing>(sources_.leaves.cellCount(), monitor_, [&](Nothing&, size_t begin, size_t end) {
      for (size_t leaf = begin; leaf < end; ++leaf) {
        const BlockCells block = from_.cellsOf(sources_.parts, leaf);
        for (size_t i = 0; i < std::max<size_t>(block.cells.size(), 1); ++i) takeCell(leaf, block, i);
      }
    });
  }

  void takeCell(size_t leaf, const BlockCells& block, size_t i) {
    const Block corner = sources_.leaves.corner(leaf), end = sources_.leaves.end(leaf);
    const size_t cell = from_.firstCells[leaf] + i, cutCell = block.cells.begin + i;
    double volume = 1;
    for (size_t d = 0; d < 3; ++d) {
      const double middle = plane(d, corner[d]) / 2 + plane(d, end[d]) / 2;
      volume *= plane(d, end[d]) - plane(d, corner[d]);
      cells_.cellCorner[3 * cell + d] = corner[d];
      cells_.cellCentre[3 * cell + d] = middle;
      cells_.cellCentroid[3 * cell + d] = block.isCut() ? block.part->measures.cellCentroid[3 * cutCell + d] : middle;
    }
    cells_.cellVolume[cell] = block.isCut() ? block.part->measures.cellVolume[cutCell] : volume;
    cells_.cellLevel[cell] = sources_.leaves.cellLevel[leaf];
  }

  void takeRegions() {
    const CutMesh& whole = sources_.whole;
    cells_.cellRegion = findRegions(cells_, cutMesh_, from_, sources_);
    cutMesh_.regionCount = whole.regionCount;
    cutMesh_.hasWinding = whole.hasWinding;
    cutMesh_.regionWinding = whole.regionWinding;
    cutMesh_.regionPartWinding = whole.regionPartWinding;
    cutMesh_.regionParity = whole.regionParity;
  }

  void fillCutMesh() {
    CutMesh& to = cutMesh_;
    const auto copyFirst = [](const auto& from, size_t count, auto& items) {
      items.assign(from.begin(), from.begin() + std::ptrdiff_t(count));
    };
    copyFirst(cells_.positions, 3 * size_t(cells_.cutVertices), to.positions);
    copyFirst(cells_.faceLoopOffsets, size_t(cells_.cutFaces) + 1, to.faceLoopOffsets);
    copyFirst(cells_.loopOffsets, size_t(to.faceLoopOffsets.back()) + 1, to.loopOffsets);
    copyFirst(cells_.loopVertices, to.loopOffsets.back(), to.loopVertices);
    const size_t n = cells_.cutCells;
    copyFirst(cells_.cellHalfFaceOffsets, n + 1, to.cellHalfFaceOffsets);
    copyFirst(cells_.cellHalfFaces, to.cellHalfFaceOffsets.back(), to.cellHalfFaces);
    copyFirst(cells_.cellCorner, 3 * n, to.cellGridCell);
    copyFirst(cells_.cellRegion, n, to.cellRegion);
    to.triangleCount = sources_.whole.triangleCount;
    to.droppedTriangles = sources_.whole.droppedTriangles;
    to.parityTriangles = sources_.whole.parityTriangles;
    to.openTriangles = sources_.whole.openTriangles;
    to.madeFrom = sources_.whole.madeFrom;
  }

  Assembled from_;
  const Sources& sources_;
  detail::Monitor& monitor_;
  CellComplex cells_;
  CutMesh cutMesh_;
};

}  // namespace

RefinedCells finish(Assembled assembled, const Sources& sources, Grid grid, detail::Monitor& monitor) {
  return Finisher(std::move(assembled), sources, std::move(grid), monitor).run();
}

}  // namespace mandoline::refining
