#include "cut/stages/kept_arrays.h"

#include <functional>
#include <utility>

#include "base/run_tasks.h"

namespace mandoline::detail {
namespace {

/// Makes f(item) of all items, several in each step: most of the time goes into the loop itself.
template <class F>
void change(std::span<uint32_t> items, const F& f) {
  constexpr size_t kStep = 8;
  size_t i = 0;
  for (; i + kStep <= items.size(); i += kStep) {
    uint32_t* const some = items.data() + i;
    for (size_t k = 0; k < kStep; ++k) some[k] = f(some[k]);
  }
  for (; i < items.size(); ++i) items[i] = f(items[i]);
}

/// Places several arrays at once.
class Placer {
 public:
  explicit Placer(const KeptArrays::Arrays& arrays) : spare_(arrays.spare), out_(arrays.out), monitor_(arrays.monitor) {}

  void placeCells(const KeptRows& kept) {
    const BrickCounts& total = kept.total;
    const KeptRuns cells = kept.of(&BrickCounts::cells), halfFaces = kept.of(&BrickCounts::halfFaces), none;
    keep(&CutMesh::cellHalfFaces, [&](std::vector<uint32_t>& items) {
      const uint32_t* const facesNow = kept.facesNow.get();
      halfFaces.place(items, 1, total.halfFaces, [=](std::span<uint32_t> moved, size_t) {
        change(moved, [=](uint32_t h) { return HalfFace({facesNow[HalfFace(h).face().number]}, HalfFace(h).side()).number; });
      });
    });
    keepAs(&CutMesh::cellGridCell, cells, 3, total.cells);
    keepAs(&CutMesh::cellRegion, none, 1, total.cells);  // all are written
    keepOffsets(&CutMesh::cellHalfFaceOffsets, {cells, halfFaces}, total.cells, total.halfFaces);
    run();
  }
  void placeFaces(const KeptRows& kept, const uint32_t* verticesNow) {
    const BrickCounts& total = kept.total;
    const uint32_t triFaces = total.triFaces, faceCount = triFaces + total.pieces, loopCount = total.triLoops + total.loops,
                   loopVertices = total.triLoopVertices + total.loopVertices;
    const KeptRuns ofTri = kept.of(&BrickCounts::triFaces), ofParents = kept.of(&BrickCounts::parents),
                   faces = kept.ofFaces(&BrickCounts::triFaces, &BrickCounts::pieces),
                   loops = kept.ofFaces(&BrickCounts::triLoops, &BrickCounts::loops),
                   vertices = kept.ofFaces(&BrickCounts::triLoopVertices, &BrickCounts::loopVertices);
    keep(&CutMesh::loopVertices, [&](std::vector<uint32_t>& items) {
      vertices.place(items, 1, loopVertices,
                     [=](std::span<uint32_t> moved, size_t) { change(moved, [=](uint32_t v) { return verticesNow[v]; }); });
    });
    keepOffsets(&CutMesh::loopOffsets, {loops, vertices}, loopCount, loopVertices);
    keepOffsets(&CutMesh::faceLoopOffsets, {faces, loops}, faceCount, loopCount);
    keepOffsets(&CutMesh::faceParentOffsets, {ofTri, ofParents}, faceCount, total.parents);
    keep(&CutMesh::faceTriangle, [&](std::vector<int32_t>& items) {
      ofTri.place(items, 1, faceCount);
      fillPieces(items, kept);
    });
    keepAndFill(&CutMesh::facePlane, faces, faceCount, 0);
    keepAndFill(&CutMesh::faceAxis, faces, faceCount, int8_t(-1));
    keepAs(&CutMesh::faceParents, ofParents, 1, total.parents);
    keepAndFill(&CutMesh::faceParentSigns, ofParents, total.parents, int8_t(1));
    run();
    std::fill(out_.faceParentOffsets.begin() + triFaces, out_.faceParentOffsets.end(), total.parents);
  }
  void placeVertices(size_t count, const KeptRuns& kept) {
    keepAs(&CutMesh::positions, kept, 3, count);
    keepAs(&CutMesh::vertexCell, kept, 3, count);
    keepAs(&CutMesh::vertexParents, kept, 2, count);
    keepAs(&CutMesh::vertexMask, kept, 1, count);
    keepAndFill(&CutMesh::vertexTriVertex, kept, count, -1);
    run();
  }

 private:
  /// Where there were tri-cut-faces, or nothing.
  static void fillPieces(std::vector<int32_t>& faceTriangle, const KeptRows& kept) {
    const size_t first = kept.total.triFaces, past = faceTriangle.size(), firstBefore = kept.totalBefore.triFaces,
                 pastBefore = firstBefore + kept.totalBefore.pieces;
    const auto fill = [&](size_t begin, size_t end) {
      if (begin < end) std::fill(faceTriangle.begin() + ptrdiff_t(begin), faceTriangle.begin() + ptrdiff_t(end), -1);
    };
    fill(first, std::min(firstBefore, past));
    fill(std::max(first, pastBefore), past);
  }
  /// Of an array of the cut before; `place(array)` brings what is kept of it to where it is now.
  template <class Item, class Place>
  void keep(std::vector<Item> CutMesh::*array, const Place& place) {
    std::vector<Item>& items = out_.*array = std::move(spare_.*array);
    tasks_.push_back([&items, place] { place(items); });
  }
  template <class Item>
  void keepAs(std::vector<Item> CutMesh::*array, const KeptRuns& kept, size_t each, size_t count) {
    keep(array, [&kept, each, count](std::vector<Item>& items) { kept.place(items, each, count); });
  }
  template <class Item>
  void keepAndFill(std::vector<Item> CutMesh::*array, const KeptRuns& kept, size_t count, Item fill) {
    keep(array, [&kept, count, fill](std::vector<Item>& items) { kept.placeAndFill(items, count, fill); });
  }
  struct KeptOffsets {
    const KeptRuns &groups, &items;
  };
  void keepOffsets(std::vector<uint32_t> CutMesh::*array, const KeptOffsets& kept, size_t count, uint32_t end) {
    keep(array, [kept, count, end](std::vector<uint32_t>& offsets) {
      kept.groups.place(offsets, 1, count + 1, [&](std::span<uint32_t> moved, size_t run) {
        const uint32_t shift = kept.items.runs[run].first - kept.items.runs[run].before;
        if (shift != 0) change(moved, [=](uint32_t offset) { return offset + shift; });
      });
      offsets.back() = end;
    });
  }
  void run() { runTasks(std::exchange(tasks_, {}), monitor_); }

  CutMesh &spare_, &out_;
  Monitor& monitor_;
  std::vector<std::function<void()>> tasks_;
};

}  // namespace

/// Inner kept bricks are not written. Others beside them have to know some of their numbers.
BricksToNumber ArraysBefore::bricksToNumber(const CutState& state) const {
  const Bricks& bricks = state.bricks;
  IdVector<BrickId, uint8_t> areNeeded(bricks.size(), 0);
  BricksToNumber result;
  for (const BrickId b : bricks.ids()) {
    if (state.kept->isInner(b)) continue;
    result.others.push_back(b.number);
    areNeeded[b] = 1;
    bricks.grid.forAround(bricks.boxes[b], [&](const Slab& cell) {
      if (const std::optional<BrickId> beside = bricks.find(cell)) areNeeded[*beside] = 1;
    });
  }
  for (const BrickId b : bricks.ids()) {
    if (areNeeded[b]) result.own.push_back(b.number);
  }
  return result;
}

void ArraysBefore::begin(const VerticesBefore& before, const CutState& state, const KeptRuns& vertices) {
  vertices_ = vertices;
  rows_ = findKeptRows(before, *state.kept, state.cut(), state.numbers);
}

void ArraysBefore::placeCells(const Arrays& arrays) const { Placer(arrays).placeCells(rows_); }

void ArraysBefore::placeFaces(const Arrays& arrays) const {
  Placer(arrays).placeFaces(rows_, vertices_.numbersNow(arrays.spare.vertexCount()).get());
}

void ArraysBefore::placeVertices(const Arrays& arrays, size_t count) const { Placer(arrays).placeVertices(count, vertices_); }

}  // namespace mandoline::detail
