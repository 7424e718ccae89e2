#include "cut/stages/bricks.h"

#include "base/key_numbers.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

template <class Item>
struct Given {
  uint32_t brick;
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
    for (const uint64_t key : unchanged) found_.add(key);
  }

  Bricks run() {
    if (firstChanged_ == 0) {
      givenParts_.reserve(parts_.clipped.parts.size());
      givenEdges_.reserve(2 * parts_.clipped.hybridEdges.size());
    }
    for (uint32_t i = 0; i < parts_.clipped.parts.size(); ++i) give(parts_.clipped.parts[i].brick, i, givenParts_);
    for (const FaceId f : parts_.divided.ids()) placeDivided(f);
    placeEdges();
    placeSeamVertices();
    return sorted();
  }

 private:
  template <class Item>
  void give(uint64_t key, Item item, std::vector<Given<Item>>& given) {
    const uint32_t brick = found_.add(key);
    if (brick >= firstChanged_) given.push_back({brick, item});
  }

  void placeDivided(FaceId f) {
    const Slab& element = parts_.divided.elements[f];
    grid_.forBricks(element, [&](const Slab& cell) { give(grid_.keyOf(cell), f, givenFaces_); });
    if (!parts_.divided.touchesLine[f] || !grid_.isBesideSeam(element)) return;
    for (const auto loop : parts_.divided.loopsOf(f)) {
      for (const VertexId v : loop) noteSeamVertex(v);
    }
  }

  void placeEdges() {
    const size_t hybrid = parts_.clipped.hybridEdges.size() + parts_.divided.hybridEdges.size();
    for (uint32_t i = 0; i < hybrid + surface_.edgesInPlane.size(); ++i) {
      const FaceEdge& edge = faceEdge(surface_, parts_, i);
      grid_.forBricks(edge.element, [&](const Slab& cell) { give(grid_.keyOf(cell), i, givenEdges_); });
      if (i < hybrid) continue;
      noteSeamVertex(edge.from);
      noteSeamVertex(edge.to);
    }
  }

  void noteSeamVertex(VertexId v) {
    const Slab& slab = surface_.vertices.slab(v);
    if (planeCount(slab) > 1 && grid_.isOnSeam(slab)) seamVertices_.push_back(v);
  }

  void placeSeamVertices() {
    sortUnique(seamVertices_);
    for (const VertexId v : seamVertices_) {
      grid_.forBricks(surface_.vertices.slab(v), [&](const Slab& cell) {
        const auto brick = found_.find(grid_.keyOf(cell));
        if (brick && *brick >= firstChanged_) givenVertices_.push_back({*brick, v});
      });
    }
  }

  /// With bricks in their order.
  Bricks sorted() {
    std::vector<uint32_t> order(found_.keys.size());
    for (uint32_t b = 0; b < order.size(); ++b) order[b] = b;
    sortItems(order, [&](uint32_t a, uint32_t b) { return found_.keys[a] < found_.keys[b]; });
    newIds_.resize(order.size());
    Bricks bricks;
    bricks.grid = grid_;
    for (uint32_t i = 0; i < order.size(); ++i) newIds_[order[i]] = bricks.add(found_.keys[order[i]]);
    bricks.parts = grouped(givenParts_);
    bricks.dividedFaces = grouped(givenFaces_);
    bricks.faceEdges = grouped(givenEdges_);
    bricks.seamVertices = grouped(givenVertices_);
    bricks.here = {{0}, {uint32_t(bricks.size())}, false};
    return bricks;
  }

  template <class Item>
  Csr<Item, BrickId> grouped(const std::vector<Given<Item>>& given) const {
    return groupBy<Item, BrickId>(
        newIds_.size(), given.size(), [&](size_t i) { return newIds_[given[i].brick]; }, [&](size_t i) { return given[i].item; });
  }

  const Surface& surface_;
  const SurfaceParts& parts_;
  const BrickGrid& grid_;
  KeyNumbers found_;             // bricks, numbered in the order in which they are found
  const uint32_t firstChanged_;  // those below are unchanged
  std::vector<Given<uint32_t>> givenParts_, givenEdges_;
  std::vector<Given<FaceId>> givenFaces_;
  std::vector<Given<VertexId>> givenVertices_;
  std::vector<VertexId> seamVertices_;
  std::vector<BrickId> newIds_;
};

}  // namespace

const FaceEdge& faceEdge(const Surface& surface, const SurfaceParts& parts, uint32_t i) {
  const auto &clipped = parts.clipped.hybridEdges, &divided = parts.divided.hybridEdges;
  if (i < clipped.size()) return clipped[i];
  if (i < clipped.size() + divided.size()) return divided[i - clipped.size()];
  return surface.edgesInPlane[i - clipped.size() - divided.size()];
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

Bricks layOutBricks(const Surface& surface, const SurfaceParts& parts, const BrickGrid& grid, const std::vector<uint64_t>& unchanged) {
  return Layout(surface, parts, grid, unchanged).run();
}

}  // namespace mandoline::detail
