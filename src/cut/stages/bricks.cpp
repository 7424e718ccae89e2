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
  Layout(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid, const std::vector<uint64_t>& unchanged)
      : surface_(surface),
        parts_(parts),
        grid_(grid),
        firstChanged_(uint32_t(unchanged.size())),
        seamVertices_(parts.clipped.seamVertices) {
    for (KeyNumbers* numbers : {&ofParts_, &found_}) {
      for (const uint64_t key : unchanged) numbers->add(key);
    }
  }

  Bricks run(Monitor& monitor) {
    runBoth([&] { placeParts(); }, [&] { placeOthers(); }, monitor);
    Bricks bricks = sorted();
    runBoth([&] { bricks.parts = grouped(givenParts_, bricks, idsOf(ofParts_, bricks)); }, [&] { groupOthers(bricks); }, monitor);
    return bricks;
  }

 private:
  template <class Item>
  void give(uint64_t key, Item item, KeyNumbers& numbers, std::vector<Given<Item>>& given) {
    const uint32_t brick = numbers.add(key);
    if (brick >= firstChanged_) given.push_back({brick, item});
  }

  void placeParts() {
    const std::vector<ClippedTriangles::Part>& parts = parts_.clipped.parts;
    if (firstChanged_ == 0) givenParts_.reserve(parts.size());
    for (uint32_t i = 0; i < parts.size(); ++i) give(parts[i].brick, i, ofParts_, givenParts_);
  }

  void placeOthers() {
    for (const FaceId f : parts_.divided.ids()) placeDivided(f);
    placeEdges();
  }

  void placeDivided(FaceId f) {
    const Slab& element = parts_.divided.elements[f];
    grid_.forBricks(element, [&](const Slab& cell) { give(grid_.keyOf(cell), f, found_, givenFaces_); });
    if (!parts_.divided.touchesLine[f] || !grid_.isBesideSeam(element)) return;
    for (const auto loop : parts_.divided.loopsOf(f)) {
      for (const VertexId v : loop) noteSeamVertex(v);
    }
  }

  void placeEdges() {
    if (firstChanged_ == 0) givenEdges_.reserve(2 * parts_.clipped.hybridEdges.size());
    const size_t hybrid = parts_.clipped.hybridEdges.size() + parts_.divided.hybridEdges.size();
    for (uint32_t i = 0; i < hybrid + surface_.edgesInPlane.size(); ++i) {
      const FaceEdge& edge = faceEdge(surface_, parts_, i);
      grid_.forBricks(edge.element, [&](const Slab& cell) { give(grid_.keyOf(cell), i, found_, givenEdges_); });
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

  void placeSeamVertices(const Bricks& bricks) {
    sortUnique(seamVertices_);
    for (const VertexId v : seamVertices_) {
      grid_.forBricks(surface_.vertices.slab(v), [&](const Slab& cell) {
        const auto brick = bricks.find(cell);
        if (brick && !isUnchanged(bricks.keys[*brick])) givenVertices_.push_back({brick->number, v});
      });
    }
  }

  bool isUnchanged(uint64_t key) const {
    const auto number = firstChanged_ > 0 ? found_.find(key) : std::nullopt;
    return number && *number < firstChanged_;
  }

  void groupOthers(Bricks& bricks) {
    placeSeamVertices(bricks);
    const std::vector<BrickId> ids = idsOf(found_, bricks);
    bricks.dividedFaces = grouped(givenFaces_, bricks, ids);
    bricks.faceEdges = grouped(givenEdges_, bricks, ids);
    bricks.seamVertices = groupBy<VertexId, BrickId>(
        bricks.size(), givenVertices_.size(), [&](size_t i) { return BrickId{givenVertices_[i].brick}; },
        [&](size_t i) { return givenVertices_[i].item; });
  }

  static std::vector<BrickId> idsOf(const KeyNumbers& numbers, const Bricks& bricks) {
    std::vector<BrickId> ids;
    for (const uint64_t key : numbers.keys)
      ids.push_back({uint32_t(std::lower_bound(bricks.keys.begin(), bricks.keys.end(), key) - bricks.keys.begin())});
    return ids;
  }

  template <class Item>
  static Csr<Item, BrickId> grouped(const std::vector<Given<Item>>& given, const Bricks& bricks, const std::vector<BrickId>& ids) {
    return groupBy<Item, BrickId>(
        bricks.size(), given.size(), [&](size_t i) { return ids[given[i].brick]; }, [&](size_t i) { return given[i].item; });
  }

  const Surface& surface_;
  const SurfaceParts& parts_;
  const BrickGrid& grid_;
  KeyNumbers ofParts_, found_;   // bricks of parts and of all else, numbered in the order in which they are found
  const uint32_t firstChanged_;  // those below are unchanged
  std::vector<Given<uint32_t>> givenParts_, givenEdges_;
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
  keys.push_back(key);
  boxes.push_back(grid.boxOf(key));
  firstBit.push_back(64 * touched.size());
  touched.resize(touched.size() + wordCount(brick), 0);
  return brick;
}

std::optional<BrickId> Bricks::find(const Slab& cell) const {
  const uint64_t key = grid.keyOf(cell);
  const auto found = std::lower_bound(keys.begin(), keys.end(), key);
  if (found == keys.end() || *found != key) return {};
  return BrickId{uint32_t(found - keys.begin())};
}

std::optional<BrickId> Bricks::findTouched(const Slab& cell) const {
  const auto brick = find(cell);
  if (!brick || !isTouched(*brick, boxes[*brick].indexOf(cell))) return {};
  return brick;
}

Bricks layOutBricks(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid, Monitor& monitor,
                    const std::vector<uint64_t>& unchanged) {
  return Layout(surface, parts, grid, unchanged).run(monitor);
}

}  // namespace mandoline::detail
