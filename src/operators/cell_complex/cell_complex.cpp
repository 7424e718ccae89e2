#include "mandoline/cell_complex.h"

#include <algorithm>

#include "base/run_tasks.h"
#include "mandoline/measure.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/cell_complex/grid_corners.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/cell_complex/octree_index.h"
#include "operators/coarsen/morton_order.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using operators::GridCorners;
using operators::GridIndex;
using operators::OctreeIndex;

constexpr const char* kOther = "The octree cells are not those of this cut-mesh.";

class Builder {
 public:
  Builder(const CutMesh& cutMesh, const OctreeCells& octree, detail::Monitor& monitor)
      : cutMesh_(cutMesh), octree_(octree), monitor_(monitor), index_(octree), corners_(cutMesh, octree) {}

  CellComplex run(Measures measures) {
    takeFaces(measures);
    takeCells(measures);
    addVertices();
    monitor_.beginStage("faces", 0);
    const std::vector<Place> places = placeFaces();
    monitor_.beginStage("cells", 1);
    addFaces(places);
    addCells();
    operators::gatherHalfFaces(result_);
    return std::move(result_);
  }

 private:
  /// Where faces of octree cells begin.
  struct Place {
    size_t face = 0, corner = 0;
  };

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
      const int64_t octreeCell = index_.find({int32_t(cell % nx), int32_t(cell / nx % ny), int32_t(cell / nx / ny)}, 0);
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
    result_.cellVolume = std::move(measures.cellVolume);
    result_.cellCentroid = std::move(measures.cellCentroid);
    result_.cellCorner = cutMesh_.cellGridCell;
    result_.cellLevel.assign(cutMesh_.cellCount(), 0);
    for (size_t i = 0; i < result_.cellCorner.size(); ++i)
      result_.cellCentre.push_back(middle(i % 3, result_.cellCorner[i], result_.cellCorner[i] + 1));
  }

  void addVertices() {
    result_.cutVertices = uint32_t(cutMesh_.vertexCount());
    result_.positions.reserve(cutMesh_.positions.size() + 3 * corners_.added().size());
    result_.positions = cutMesh_.positions;
    for (const GridIndex& corner : corners_.added()) {
      for (size_t d = 0; d < 3; ++d) result_.positions.push_back(plane(d, corner[d]));
    }
  }

  /// Calls f(axis, side, neighbour, tag) for the faces of an octree cell, except those that smaller cells, cut-cells or a cell of its size
  /// that comes before it have.
  template <class F>
  void forSides(size_t c, const F& f) const {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    const int level = octree_.cellLevel[c];
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        GridIndex across = corner;
        across[axis] = side ? end[axis] : corner[axis] - 1;
        if (across[axis] < 0 || across[axis] >= octree_.gridCells[axis]) {
          f(axis, side, -1, FaceTag(2 * int(axis) + side));
          continue;
        }
        const int64_t neighbour = index_.find(across, level);
        if (neighbour < 0) continue;
        if (octree_.cellLevel[size_t(neighbour)] > level || side == 1) f(axis, side, idOf(neighbour), FaceTag::inner);
      }
    }
  }

  /// Makes room for the faces of octree cells. Gives where those begin of the first cell of each chunk, as forChunks() makes them.
  std::vector<Place> placeFaces() {
    struct Counts {
      Place added;
      std::vector<uint32_t> loop;
    };
    const auto counts = detail::forChunks<Counts>(octree_.cellCount(), monitor_, [&](Counts& chunk, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        forSides(c, [&](size_t axis, int side, int32_t, FaceTag) {
          chunk.loop.clear();
          corners_.appendSide(c, axis, side, chunk.loop);
          ++chunk.added.face;
          chunk.added.corner += chunk.loop.size();
        });
      }
    });
    Place next{cutMesh_.faceCount(), result_.loopVertices.size()};
    std::vector<Place> places;
    for (const Counts& chunk : counts) {
      places.push_back(next);
      next.face += chunk.added.face;
      next.corner += chunk.added.corner;
    }
    if (next.corner >> 31 != 0) throw CallError({Status::meshTooLarge, -1, -1, "The faces have more than 2^31 corners."});
    makeRoom(next);
    return places;
  }

  /// Each array on one thread, since the first touch of memory takes long.
  void makeRoom(const Place& end) {
    const size_t cells = cutMesh_.cellCount() + octree_.cellCount(), loops = cutMesh_.loopCount() + end.face - cutMesh_.faceCount();
    const std::function<void()> rooms[] = {
        [&] { result_.faceNormal.resize(3 * end.face); },
        [&] { result_.faceCentroid.resize(3 * end.face); },
        [&] { result_.loopVertices.resize(end.corner); },
        [&] { result_.faceArea.resize(end.face); },
        [&] { result_.faceCells.resize(2 * end.face); },
        [&] { result_.cellCentre.resize(3 * cells); },
        [&] { result_.cellCentroid.resize(3 * cells); },
        [&] { result_.loopOffsets.resize(loops + 1); },
        [&] { result_.faceLoopOffsets.resize(end.face + 1); },
        [&] { result_.faceTag.resize(end.face); },
        [&] { result_.cellCorner.insert(result_.cellCorner.end(), octree_.cellCorner.begin(), octree_.cellCorner.end()); },
        [&] { result_.cellVolume.resize(cells); },
        [&] { result_.cellRegion.insert(result_.cellRegion.end(), octree_.cellRegion.begin(), octree_.cellRegion.end()); },
        [&] { result_.cellLevel.insert(result_.cellLevel.end(), octree_.cellLevel.begin(), octree_.cellLevel.end()); },
    };
    detail::runTasks(rooms, monitor_);
  }

  /// `places`: those of placeFaces().
  void addFaces(std::vector<Place> places) {
    std::vector<std::vector<uint32_t>> loops(places.size());
    detail::runChunks(
        octree_.cellCount(), places.size(), monitor_,
        [&](size_t chunk, size_t begin, size_t end) {
          for (size_t c = begin; c < end; ++c) {
            forSides(c, [&](size_t axis, int side, int32_t neighbour, FaceTag tag) {
              Place& at = places[chunk];
              addFace(at.face, c, axis, side);
              result_.faceTag[at.face] = tag;
              result_.faceCells[2 * at.face + size_t(side)] = neighbour;
              loops[chunk].clear();
              corners_.appendSide(c, axis, side, loops[chunk]);
              std::copy(loops[chunk].begin(), loops[chunk].end(), result_.loopVertices.begin() + std::ptrdiff_t(at.corner));
              at.corner += loops[chunk].size();
              ++at.face;
              result_.loopOffsets[cutMesh_.loopCount() + at.face - cutMesh_.faceCount()] = uint32_t(at.corner);
            });
          }
        },
        kBlock);
  }

  /// The side of an octree cell becomes face f.
  void addFace(size_t f, size_t c, size_t axis, int side) {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    result_.faceCells[2 * f + size_t(1 - side)] = idOf(int64_t(c));
    result_.faceArea[f] = (plane(u, end[u]) - plane(u, corner[u])) * (plane(v, end[v]) - plane(v, corner[v]));
    for (size_t d = 0; d < 3; ++d) {
      result_.faceNormal[3 * f + d] = d == axis;
      result_.faceCentroid[3 * f + d] = d == axis ? plane(d, (side ? end : corner)[d]) : middle(d, corner[d], end[d]);
    }
    result_.faceLoopOffsets[f + 1] = uint32_t(cutMesh_.loopCount() + f + 1 - cutMesh_.faceCount());
  }

  /// Of octree cells, what is not yet known.
  void addCells() {
    detail::runChunks(
        octree_.cellCount(), detail::chunkCount(octree_.cellCount(), monitor_, kBlock), monitor_,
        [&](size_t, size_t begin, size_t end) {
          for (size_t c = begin; c < end; ++c) addCell(c);
        },
        kBlock);
  }

  void addCell(size_t c) {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    const size_t id = cutMesh_.cellCount() + c;
    double volume = 1;
    for (size_t d = 0; d < 3; ++d) {
      volume *= plane(d, end[d]) - plane(d, corner[d]);
      result_.cellCentroid[3 * id + d] = result_.cellCentre[3 * id + d] = middle(d, corner[d], end[d]);
    }
    result_.cellVolume[id] = volume;
  }

  double plane(size_t axis, int32_t index) const { return cutMesh_.grid.planes[axis][size_t(index)]; }
  double middle(size_t axis, int32_t from, int32_t to) const { return plane(axis, from) / 2 + plane(axis, to) / 2; }

  static constexpr size_t kBlock = 2048;  // cells

  const CutMesh& cutMesh_;
  const OctreeCells& octree_;
  detail::Monitor& monitor_;
  OctreeIndex index_;
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
    for (size_t d = 0; d < 3; ++d) {
      if (corner[d] < 0 || corner[d] >= octree.gridCells[d] || corner[d] % (1 << octree.cellLevel[c]) != 0) return false;
    }
    if (c > 0 && !operators::isBefore(octree.corner(c - 1), corner)) return false;
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
