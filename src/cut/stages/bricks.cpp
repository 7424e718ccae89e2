#include "cut/stages/bricks.h"

#include "base/key_numbers.h"
#include "base/run_tasks.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

template <class Item>
struct Given {
  uint32_t brick;  ///< its number
  Item item;
};

class Layout {
 public:
  Layout(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid)
      : surface_(surface), parts_(parts), grid_(grid), seamVertices_(parts.clipped.seamVertices) {}

  Bricks run(Monitor& monitor) {
    runBoth([&] { placeParts(); }, [&] { placeOthers(); }, monitor);
    Bricks bricks = sorted();
    runBoth([&] { groupParts(bricks); }, [&] { groupOthers(bricks); }, monitor);
    return bricks;
  }

 private:
  void placeParts() {
    const std::vector<ClippedTriangles::Part>& parts = parts_.clipped.parts;
    bricksOfParts_.resize(parts.size());
    for (size_t i = 0; i < parts.size(); ++i) bricksOfParts_[i] = ofParts_.addAny(parts[i].brick);
  }

  void placeOthers() {
    for (const FaceId f : parts_.divided.ids()) placeDivided(f);
    placeEdges();
  }

  void placeDivided(FaceId f) {
    const Slab& element = parts_.divided.elements[f];
    grid_.forBricks(element, [&](const Slab& cell) { givenFaces_.push_back({found_.add(grid_.keyOf(cell)), f}); });
    if (!parts_.divided.touchesLine[f] || !grid_.isBesideSeam(element)) return;
    for (const auto loop : parts_.divided.loopsOf(f)) {
      for (const VertexId v : loop) noteSeamVertex(v);
    }
  }

  void placeEdges() {
    givenEdges_.reserve(2 * parts_.clipped.hybridEdges.size());
    const size_t hybrid = parts_.clipped.hybridEdges.size() + parts_.divided.hybridEdges.size();
    for (uint32_t i = 0; i < hybrid + surface_.edgesInPlane.size(); ++i) {
      const FaceEdge& edge = faceEdge(surface_, parts_, i);
      grid_.forBricks(edge.element, [&](const Slab& cell) { givenEdges_.push_back({found_.add(grid_.keyOf(cell)), i}); });
      if (i < hybrid) continue;
      noteSeamVertex(edge.from);
      noteSeamVertex(edge.to);
    }
  }

  void noteSeamVertex(VertexId v) {
    const Slab& slab = surface_.vertices.slab(v);
    if (planeCount(slab) > 1 && grid_.isOnSeam(slab)) seamVertices_.push_back(v);
  }

  /// With bricks in their order.
  Bricks sorted() {
    std::vector<uint64_t> keys = found_.keys;
    keys.insert(keys.end(), ofParts_.keys.begin(), ofParts_.keys.end());
    sortUnique(keys);
    Bricks bricks;
    bricks.grid = grid_;
    for (const uint64_t key : keys) bricks.add(key);
    bricks.here = {{0}, {uint32_t(bricks.size())}, false};
    return bricks;
  }

  void groupParts(Bricks& bricks) const {
    const std::vector<BrickId> ids = idsOf(ofParts_, bricks);
    bricks.parts = groupBy<uint32_t, BrickId>(
        bricks.size(), bricksOfParts_.size(), [&](size_t i) { return ids[bricksOfParts_[i]]; }, [](size_t i) { return uint32_t(i); });
  }

  void placeSeamVertices(const Bricks& bricks) {
    sortUnique(seamVertices_);
    for (const VertexId v : seamVertices_) {
      grid_.forBricks(surface_.vertices.slab(v), [&](const Slab& cell) {
        const auto brick = bricks.find(cell);
        if (brick) givenVertices_.push_back({brick->number, v});
      });
    }
  }

  void groupOthers(Bricks& bricks) {
    placeSeamVertices(bricks);
    const std::vector<BrickId> ids = idsOf(found_, bricks);
    const auto found = [&](uint32_t brick) { return ids[brick]; };
    bricks.dividedFaces = grouped(givenFaces_, bricks, found);
    bricks.faceEdges = grouped(givenEdges_, bricks, found);
    bricks.seamVertices = grouped(givenVertices_, bricks, [](uint32_t brick) { return BrickId{brick}; });
  }

  static std::vector<BrickId> idsOf(const KeyNumbers& numbers, const Bricks& bricks) {
    std::vector<BrickId> ids;
    for (const uint64_t key : numbers.keys)
      ids.push_back({uint32_t(std::lower_bound(bricks.keys.begin(), bricks.keys.end(), key) - bricks.keys.begin())});
    return ids;
  }

  template <class Item, class IdOf>
  static Csr<Item, BrickId> grouped(const std::vector<Given<Item>>& given, const Bricks& bricks, const IdOf& idOf) {
    return groupBy<Item, BrickId>(
        bricks.size(), given.size(), [&](size_t i) { return idOf(given[i].brick); }, [&](size_t i) { return given[i].item; });
  }

  const Surface& surface_;
  const SurfaceParts& parts_;
  const BrickGrid& grid_;
  // Bricks of parts and of all else, numbered in the order in which they are found. In cache lines apart: two threads find them.
  alignas(128) KeyNumbers ofParts_;
  std::vector<uint32_t> bricksOfParts_;
  alignas(128) KeyNumbers found_;
  std::vector<Given<uint32_t>> givenEdges_;
  std::vector<Given<FaceId>> givenFaces_;
  std::vector<Given<VertexId>> givenVertices_;
  std::vector<VertexId> seamVertices_;
};

}  // namespace

const FaceEdge& faceEdge(const Surface& surface, const SurfaceParts& parts, uint32_t i) {
  const auto &clipped = parts.clipped.hybridEdges, &divided = parts.divided.hybridEdges;
  if (i < clipped.size()) return clipped[i];
  if (i < clipped.size() + divided.size()) return divided[i - clipped.size()];
  return surface.edgesInPlane[i - clipped.size() - divided.size()];
}

std::vector<uint32_t> BricksHere::numbers(unsigned threads) const {
  std::vector<uint32_t> numbers;
  const size_t step = (size() + threads - 1) / threads;
  for (size_t i = 0; i < step; ++i) {
    for (size_t at = i; at < size(); at += step) numbers.push_back(first.number + uint32_t(at));
  }
  return numbers;
}

BrickId Bricks::add(uint64_t key) {
  const BrickId brick{uint32_t(size())};
  const size_t row = size_t(key / uint64_t(grid.counts[0]));
  if (row >= rows.size()) rows.resize(row + 1, brick.number);
  keys.push_back(key);
  boxes.push_back(grid.boxOf(key));
  firstBit.push_back(64 * touched.size());
  touched.resize(touched.size() + wordCount(brick), 0);
  return brick;
}

std::optional<BrickId> Bricks::find(const Slab& cell) const {
  const size_t row = size_t(grid.rowOf(cell));
  if (row >= rows.size()) return {};
  const auto first = keys.begin() + ptrdiff_t(rows[row]),
             past = row + 1 < rows.size() ? keys.begin() + ptrdiff_t(rows[row + 1]) : keys.end();
  const uint64_t key = grid.keyOf(cell);
  const auto found = std::lower_bound(first, past, key);
  if (found == past || *found != key) return {};
  return BrickId{uint32_t(found - keys.begin())};
}

std::optional<BrickId> Bricks::findTouched(const Slab& cell) const {
  const auto brick = find(cell);
  if (!brick || !isTouched(*brick, boxes[*brick].indexOf(cell))) return {};
  return brick;
}

Bricks layOutBricks(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid, Monitor& monitor) {
  return Layout(surface, parts, grid).run(monitor);
}

}  // namespace mandoline::detail
