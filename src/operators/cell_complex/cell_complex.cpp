#include "mandoline/cell_complex.h"

#include <algorithm>

#include "mandoline/measure.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/cell_complex/grid_corners.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using operators::GridCorners;
using operators::GridIndex;

constexpr const char* kOther = "The octree cells are not those of this cut-mesh.";

class Builder {
 public:
  Builder(const CutMesh& cutMesh, const OctreeCells& octree, detail::Monitor& monitor)
      : cutMesh_(cutMesh), octree_(octree), monitor_(monitor), corners_(cutMesh, octree) {}

  CellComplex run(Measures measures) {
    takeFaces(measures);
    takeCells(measures);
    addVertices();
    monitor_.beginStage("faces", 0);
    for (size_t c = 0; c < octree_.cellCount(); ++c) {
      if (c % 4096 == 0) monitor_.report(c, octree_.cellCount());
      for (size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) addSide(c, axis, side);
      }
    }
    monitor_.beginStage("cells", 1);
    operators::gatherHalfFaces(result_);
    return std::move(result_);
  }

 private:
  void takeFaces(Measures& measures) {
    result_.cutFaces = uint32_t(cutMesh_.faceCount());
    result_.loopOffsets = cutMesh_.loopOffsets;
    result_.loopVertices = cutMesh_.loopVertices;
    result_.faceLoopOffsets = cutMesh_.faceLoopOffsets;
    result_.faceArea = std::move(measures.faceArea);
    result_.faceNormal = std::move(measures.faceNormal);
    result_.faceCentroid = std::move(measures.faceCentroid);
    const Adjacency beside = adjacency(cutMesh_);
    result_.faceCells = beside.faceCells;
    const int64_t nx = octree_.gridCells[0], ny = octree_.gridCells[1];
    for (size_t h = 0; h < result_.faceCells.size(); ++h) {
      const int64_t cell = beside.faceGridCells[h];
      if (cell < 0) continue;
      const int64_t octreeCell = octree_.find(cell % nx, cell / nx % ny, cell / nx / ny);
      if (octreeCell < 0) operators::refuse(kOther);
      result_.faceCells[h] = idOf(octreeCell);
    }
    for (size_t f = 0; f < cutMesh_.faceCount(); ++f) result_.faceTag.push_back(tagOf(f));
  }

  int32_t idOf(int64_t octreeCell) const { return int32_t(int64_t(cutMesh_.cellCount()) + octreeCell); }

  FaceTag tagOf(size_t f) const {
    if (cutMesh_.faceTriangle[f] >= 0) return FaceTag::surface;
    if (result_.faceCells[2 * f] < 0) return FaceTag(2 * cutMesh_.faceAxis[f]);
    if (result_.faceCells[2 * f + 1] < 0) return FaceTag(2 * cutMesh_.faceAxis[f] + 1);
    return FaceTag::inner;
  }

  void takeCells(Measures& measures) {
    result_.cutCells = uint32_t(cutMesh_.cellCount());
    result_.cellRegion = cutMesh_.cellRegion;
    result_.cellRegion.insert(result_.cellRegion.end(), octree_.cellRegion.begin(), octree_.cellRegion.end());
    result_.cellVolume = std::move(measures.cellVolume);
    result_.cellCentroid = std::move(measures.cellCentroid);
    result_.cellCorner = cutMesh_.cellGridCell;
    for (size_t i = 0; i < result_.cellCorner.size(); ++i)
      result_.cellCentre.push_back(middle(i % 3, result_.cellCorner[i], result_.cellCorner[i] + 1));
    result_.cellCorner.insert(result_.cellCorner.end(), octree_.cellCorner.begin(), octree_.cellCorner.end());
    result_.cellLevel.assign(cutMesh_.cellCount(), 0);
    result_.cellLevel.insert(result_.cellLevel.end(), octree_.cellLevel.begin(), octree_.cellLevel.end());
    for (size_t c = 0; c < octree_.cellCount(); ++c) {
      const auto corner = octree_.corner(c), end = octree_.end(c);
      double volume = 1;
      for (size_t d = 0; d < 3; ++d) {
        volume *= plane(d, end[d]) - plane(d, corner[d]);
        result_.cellCentroid.push_back(middle(d, corner[d], end[d]));
        result_.cellCentre.push_back(middle(d, corner[d], end[d]));
      }
      result_.cellVolume.push_back(volume);
    }
  }

  void addVertices() {
    result_.cutVertices = uint32_t(cutMesh_.vertexCount());
    result_.positions = cutMesh_.positions;
    for (const GridIndex& corner : corners_.added()) {
      for (size_t d = 0; d < 3; ++d) result_.positions.push_back(plane(d, corner[d]));
    }
  }

  /// The face of an octree cell on one side, unless smaller cells, cut-cells or a cell of its size that comes before it have it.
  void addSide(size_t c, size_t axis, int side) {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    GridIndex across = corner;
    across[axis] = side ? end[axis] : corner[axis] - 1;
    if (across[axis] < 0 || across[axis] >= octree_.gridCells[axis]) return addFace(c, axis, side, -1, FaceTag(2 * int(axis) + side));
    const int64_t neighbour = octree_.find(across[0], across[1], across[2]);
    if (neighbour < 0) return;  // cut: the face is one of the cut-mesh's
    const int levels = int(octree_.cellLevel[size_t(neighbour)]) - int(octree_.cellLevel[c]);
    if (levels > 0 || (levels == 0 && side == 1)) addFace(c, axis, side, idOf(neighbour), FaceTag::inner);
  }

  void addFace(size_t c, size_t axis, int side, int32_t neighbour, FaceTag tag) {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    const int32_t cells[2] = {idOf(int64_t(c)), neighbour};
    result_.faceCells.insert(result_.faceCells.end(), {cells[side ? 0 : 1], cells[side ? 1 : 0]});
    result_.faceTag.push_back(tag);

    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    result_.faceArea.push_back((plane(u, end[u]) - plane(u, corner[u])) * (plane(v, end[v]) - plane(v, corner[v])));
    for (size_t d = 0; d < 3; ++d) {
      result_.faceNormal.push_back(d == axis);
      result_.faceCentroid.push_back(d == axis ? plane(d, (side ? end : corner)[d]) : middle(d, corner[d], end[d]));
    }

    corners_.appendSide(c, axis, side, result_.loopVertices);
    if (result_.loopVertices.size() >> 31 != 0) throw CallError({Status::meshTooLarge, -1, -1, "The faces have more than 2^31 corners."});
    result_.loopOffsets.push_back(uint32_t(result_.loopVertices.size()));
    result_.faceLoopOffsets.push_back(uint32_t(result_.loopOffsets.size()) - 1);
  }

  double plane(size_t axis, int32_t index) const { return cutMesh_.grid.planes[axis][size_t(index)]; }
  double middle(size_t axis, int32_t from, int32_t to) const { return plane(axis, from) / 2 + plane(axis, to) / 2; }

  const CutMesh& cutMesh_;
  const OctreeCells& octree_;
  detail::Monitor& monitor_;
  GridCorners corners_;
  CellComplex result_;
};

constexpr int kMostLevel = 24;  // of a block that holds the largest grid

/// Whether octree cells are in order, apart from each other, and one per block.
bool isOctree(const OctreeCells& octree) {
  const size_t count = octree.cellCount();
  if (octree.cellCorner.size() != 3 * count || octree.cellRegion.size() != count) return false;
  for (size_t c = 0; c < count; ++c) {
    if (octree.cellLevel[c] > kMostLevel) return false;
  }
  GridIndex end{};
  for (size_t c = 0; c < count; ++c) {
    const GridIndex corner = octree.corner(c);
    for (const int32_t x : corner) {
      if (x % (1 << octree.cellLevel[c]) != 0) return false;
    }
    if (octree.find(corner[0], corner[1], corner[2]) != int64_t(c)) return false;
    if (c > 0 && corner[0] < end[0] && corner[1] < end[1] && corner[2] < end[2]) return false;  // inside the one before
    end = octree.end(c);
  }
  return true;
}

/// Refuses octree cells of another cut-mesh, and arrays that don't fit together.
void requireOctree(const CutMesh& cutMesh, const OctreeCells& octree) {
  operators::requireMadeFrom(octree.madeFrom, cutMesh.fingerprint, kOther);
  for (size_t d = 0; d < 3; ++d) {
    if (octree.gridCells[d] != cutMesh.grid.cells(int(d))) operators::refuse("The octree cells are of another grid.");
  }
  const auto exists = [&](uint32_t region) { return region < cutMesh.regionCount; };
  if (!isOctree(octree) || !std::all_of(octree.cellRegion.begin(), octree.cellRegion.end(), exists)) operators::refuse(kOther);
}

}  // namespace

CellComplex cellComplex(const MeshView& mesh, const CutMesh& cutMesh, const OctreeCells& octree, const RunOptions& options) {
  operators::requireCutMesh(cutMesh);
  requireOctree(cutMesh, octree);
  Measures measures = measure(mesh, cutMesh, options);
  return detail::runCall("assembly of the cells", [&] {
    detail::Monitor monitor(options, 2);
    CellComplex cells = Builder(cutMesh, octree, monitor).run(std::move(measures));
    detail::Fingerprinter fingerprinter("cells", cutMesh.fingerprint);
    fingerprinter.add(octree.fingerprint.value);
    cells.madeFrom = cutMesh.fingerprint;
    cells.fingerprint = octree.fingerprint.isKnown() ? fingerprinter.get() : Fingerprint{};
    return cells;
  });
}

}  // namespace mandoline
