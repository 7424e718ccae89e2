#include "mandoline/cell_complex.h"

#include <algorithm>
#include <optional>

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "mandoline/measure.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/cell_complex/grid_corners.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/cell_complex/in_layers.h"
#include "operators/cell_complex/octree_index.h"
#include "operators/coarsen/morton_order.h"
#include "operators/measure/owners.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using operators::GridCorners;
using operators::GridIndex;
using operators::OctreeIndex;

constexpr const char* kOther = "The octree cells are not those of this cut-mesh.";

class Builder {
 public:
  /// `layers`: those that there are cells of, along z. Octree cells may reach out of them.
  Builder(const CutMesh& cutMesh, const OctreeCells& octree, const std::array<int64_t, 2>& layers, Measures measures,
          detail::Monitor& monitor)
      : cutMesh_(cutMesh), octree_(octree), layers_(layers), measures_(std::move(measures)), monitor_(monitor) {}

  CellComplex run() {
    monitor_.beginStage("faces", 0);
    index();
    takeFaces();
    takeCells();
    const std::vector<Place> places = placeFaces();
    monitor_.beginStage("cells", 1);
    addFaces(places);
    inChunks(octree_.cellCount(), [&](size_t c) { addCell(c); });
    operators::gatherHalfFaces(result_, monitor_.threads());
    return std::move(result_);
  }

 private:
  /// Where faces of octree cells begin.
  struct Place {
    size_t face = 0, corner = 0;
  };

  void index() {
    const std::function<void()> tasks[] = {
        [&] { corners_->setPlaces(); },
        [&] { corners_->linkCutVertices(); },
        [&] { index_.emplace(octree_); },
    };
    corners_.emplace(cutMesh_, octree_);
    detail::runTasks(tasks, monitor_);
  }

  void takeFaces() {
    result_.cutFaces = uint32_t(cutMesh_.faceCount());
    result_.faceCells = operators::ownersOf(cutMesh_);
    const std::vector<int64_t> gridCells = operators::gridCellsBeside(cutMesh_, result_.faceCells);
    const int64_t nx = octree_.gridCells[0], ny = octree_.gridCells[1];
    const auto take = [&](size_t h) {
      const int64_t cell = gridCells[h];
      if (cell < 0 || !isInLayers(int32_t(cell / nx / ny))) return;
      const int64_t octreeCell = index_->find({int32_t(cell % nx), int32_t(cell / nx % ny), int32_t(cell / nx / ny)}, 0);
      if (octreeCell < 0) operators::refuse(kOther);
      result_.faceCells[h] = idOf(octreeCell);
    };
    result_.faceTag.resize(cutMesh_.faceCount());
    inChunks(cutMesh_.faceCount(), [&](size_t f) {
      take(2 * f), take(2 * f + 1);
      result_.faceTag[f] = tagOf(f);
    });
  }

  int32_t idOf(int64_t octreeCell) const { return int32_t(int64_t(cutMesh_.cellCount()) + octreeCell); }

  bool isInLayers(int32_t k) const { return k >= layers_[0] && k < layers_[1]; }

  FaceTag tagOf(size_t f) const {
    if (cutMesh_.faceTriangle[f] >= 0) return FaceTag::surface;
    const size_t axis = size_t(cutMesh_.faceAxis[f]);
    for (const size_t side : {0, 1}) {
      if (result_.faceCells[2 * f + side] < 0) return tagOf(axis, int(side), cutMesh_.facePlane[f]);
    }
    return FaceTag::inner;
  }

  /// That of a face with nothing on one side.
  FaceTag tagOf(size_t axis, int side, int32_t plane) const {
    return plane == (side ? octree_.gridCells[axis] : 0) ? FaceTag(2 * int(axis) + side) : FaceTag::inner;
  }

  void takeCells() {
    result_.cutCells = uint32_t(cutMesh_.cellCount());
    for (size_t i = 0; i < cutMesh_.cellGridCell.size(); ++i)
      result_.cellCentre.push_back(middle(i % 3, cutMesh_.cellGridCell[i], cutMesh_.cellGridCell[i] + 1));
  }

  void addVertices() {
    result_.cutVertices = uint32_t(cutMesh_.vertexCount());
    result_.positions = cutMesh_.positions;
    corners_->appendPositions(result_.positions);
  }

  /// The cell across a side of an octree cell, or -1 outside the grid or the layers. Nothing if others have the faces there.
  std::optional<int32_t> acrossSide(size_t c, size_t axis, int side) const {
    if (axis == 2 && !isInLayers(side ? octree_.corner(c)[2] + (1 << octree_.cellLevel[c]) : octree_.corner(c)[2] - 1)) return -1;
    const std::optional<int64_t> neighbour = index_->acrossSide(c, axis, side);
    if (!neighbour) return {};
    return *neighbour < 0 ? -1 : idOf(*neighbour);
  }

  template <class F>
  static void forSides(const F& f) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) f(axis, side);
    }
  }
  static constexpr uint8_t kPlain = 1 << 6;  // all sides have four vertices
  static uint8_t bitOf(size_t axis, int side) { return uint8_t(1 << (2 * axis + size_t(side))); }

  /// Fills sides_ and makes room for the faces of octree cells. Gives where those begin of the first cell of each chunk, as forChunks()
  /// makes them.
  std::vector<Place> placeFaces() {
    struct Counts {
      Place added;
      std::vector<uint32_t> loop;
    };
    sides_.resize(octree_.cellCount());
    const auto counts = detail::forChunks<Counts>(octree_.cellCount(), monitor_, [&](Counts& chunk, size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        const GridCorners::OfCell corners = corners_->ofCell(c);
        const bool isPlain = corners_->hasPlainSides(c, corners);
        sides_[c] = isPlain ? kPlain : 0;
        forSides([&](size_t axis, int side) {
          if (!acrossSide(c, axis, side)) return;
          sides_[c] |= bitOf(axis, side);
          chunk.loop.clear();
          if (!isPlain) corners_->appendSide(c, corners, axis, side, chunk.loop);
          ++chunk.added.face;
          chunk.added.corner += isPlain ? 4 : chunk.loop.size();
        });
      }
    });
    Place next{cutMesh_.faceCount(), cutMesh_.loopVertices.size()};
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
    using detail::longer;
    CellComplex& to = result_;
    const size_t cells = cutMesh_.cellCount() + octree_.cellCount(), loops = cutMesh_.loopCount() + end.face - cutMesh_.faceCount();
    const std::function<void()> rooms[] = {
        [&] { to.faceNormal = longer(measures_.faceNormal, 3 * end.face); },
        [&] { to.faceCentroid = longer(measures_.faceCentroid, 3 * end.face); },
        [&] { to.loopVertices = longer(cutMesh_.loopVertices, end.corner); },
        [&] { addVertices(); },
        [&] { to.faceArea = longer(measures_.faceArea, end.face); },
        [&] { to.faceCells = longer(to.faceCells, 2 * end.face); },
        [&] { to.cellCentre = longer(to.cellCentre, 3 * cells); },
        [&] { to.cellCentroid = longer(measures_.cellCentroid, 3 * cells); },
        [&] { to.loopOffsets = longer(cutMesh_.loopOffsets, loops + 1); },
        [&] { to.faceLoopOffsets = longer(cutMesh_.faceLoopOffsets, end.face + 1); },
        [&] { to.cellCorner = joined(cutMesh_.cellGridCell, octree_.cellCorner); },
        [&] { to.cellVolume = longer(measures_.cellVolume, cells); },
        [&] { to.cellRegion = joined(cutMesh_.cellRegion, octree_.cellRegion); },
        [&] { to.faceTag = longer(to.faceTag, end.face); },
        [&] { to.cellLevel = joined(std::vector<uint8_t>(cutMesh_.cellCount()), octree_.cellLevel); },
    };
    detail::runTasks(rooms, monitor_);
    measures_ = {};
  }

  template <class Item>
  static std::vector<Item> joined(const std::vector<Item>& a, const std::vector<Item>& b) {
    std::vector<Item> both = detail::longer(a, a.size() + b.size());
    std::copy(b.begin(), b.end(), both.begin() + std::ptrdiff_t(a.size()));
    return both;
  }

  /// `places`: those of placeFaces().
  void addFaces(std::vector<Place> places) {
    std::vector<std::vector<uint32_t>> loops(places.size());
    detail::runChunks(
        octree_.cellCount(), places.size(), monitor_,
        [&](size_t chunk, size_t begin, size_t end) {
          for (size_t c = begin; c < end; ++c) addFaces(c, places[chunk], loops[chunk]);
        },
        kBlock);
  }

  /// The sides of an octree cell that are faces of its own. `loop` is room for one.
  void addFaces(size_t c, Place& at, std::vector<uint32_t>& loop) {
    if (!(sides_[c] & ~kPlain)) return;
    const GridCorners::OfCell corners = corners_->ofCell(c);
    forSides([&](size_t axis, int side) {
      if (!(sides_[c] & bitOf(axis, side))) return;
      addFace(at.face, c, axis, side);
      if (sides_[c] & kPlain) {
        const auto vertices = GridCorners::ofSide(corners, axis, side);
        loop.assign(vertices.begin(), vertices.end());
      } else {
        loop.clear();
        corners_->appendSide(c, corners, axis, side, loop);
      }
      std::copy(loop.begin(), loop.end(), &result_.loopVertices[at.corner]);
      at.corner += loop.size();
      ++at.face;
      result_.loopOffsets[cutMesh_.loopCount() + at.face - cutMesh_.faceCount()] = uint32_t(at.corner);
    });
  }

  /// The side of an octree cell becomes face f.
  void addFace(size_t f, size_t c, size_t axis, int side) {
    const GridIndex corner = octree_.corner(c), end = octree_.end(c);
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int32_t neighbour = *acrossSide(c, axis, side);
    result_.faceTag[f] = neighbour < 0 ? tagOf(axis, side, (side ? end : corner)[axis]) : FaceTag::inner;
    result_.faceCells[2 * f + size_t(side)] = neighbour;
    result_.faceCells[2 * f + size_t(1 - side)] = idOf(int64_t(c));
    result_.faceArea[f] = (plane(u, end[u]) - plane(u, corner[u])) * (plane(v, end[v]) - plane(v, corner[v]));
    for (size_t d = 0; d < 3; ++d) {
      result_.faceNormal[3 * f + d] = d == axis;
      result_.faceCentroid[3 * f + d] = d == axis ? plane(d, (side ? end : corner)[d]) : middle(d, corner[d], end[d]);
    }
    result_.faceLoopOffsets[f + 1] = uint32_t(cutMesh_.loopCount() + f + 1 - cutMesh_.faceCount());
  }

  /// Runs f(i) for 0..n.
  template <class F>
  void inChunks(size_t n, const F& f) {
    detail::runChunks(
        n, detail::chunkCount(n, monitor_, kBlock), monitor_,
        [&](size_t, size_t begin, size_t end) {
          for (size_t i = begin; i < end; ++i) f(i);
        },
        kBlock);
  }

  /// Of an octree cell, what is not yet known.
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
  const std::array<int64_t, 2> layers_;
  Measures measures_;  // of the cut-mesh
  detail::Monitor& monitor_;
  std::optional<OctreeIndex> index_;
  std::optional<GridCorners> corners_;
  std::vector<uint8_t> sides_;  // per octree cell: a bit for each side that is a face of its own, and kPlain
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
  uint64_t held = 0;
  for (size_t c = 0; c < octree.cellCount(); ++c) {
    const GridIndex corner = octree.corner(c), end = octree.end(c);
    held += uint64_t(end[0] - corner[0]) * uint64_t(end[1] - corner[1]) * uint64_t(end[2] - corner[2]);
  }
  if (held != UntouchedCells(cutMesh).count()) operators::refuse(kOther);
}

}  // namespace

CellComplex cellComplex(const MeshView& mesh, const CutMesh& cutMesh, const OctreeCells& octree, const RunOptions& options) {
  operators::requireCutMesh(cutMesh);
  requireOctree(cutMesh, octree);
  return operators::cellComplexInLayers(measure(mesh, cutMesh, options), cutMesh, octree, {0, octree.gridCells[2]}, options);
}

CellComplex operators::cellComplexInLayers(Measures measures, const CutMesh& cutMesh, const OctreeCells& octree,
                                           const std::array<int64_t, 2>& layers, const RunOptions& options) {
  return detail::runCall("assembly of the cells", [&] {
    detail::Monitor monitor(options, 2);
    CellComplex cells = Builder(cutMesh, octree, layers, std::move(measures), monitor).run();
    detail::Fingerprinter fingerprinter("cells", cutMesh.fingerprint);
    fingerprinter.add(octree.fingerprint.value);
    cells.madeFrom = cutMesh.fingerprint;
    cells.fingerprint = octree.fingerprint.isKnown() ? fingerprinter.get() : Fingerprint{};
    return cells;
  });
}

}  // namespace mandoline
