#include "cut/stages/kept_layout.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

class LayoutAgain {
 public:
  LayoutAgain(const Surface& surface, const SurfaceParts& parts, const ChangedBricks& changed, Bricks& before)
      : surface_(surface),
        parts_(parts),
        changed_(changed),
        before_(before),
        grid_(before.grid),
        areTouched_(changed.keys().keys.size(), 0),
        isGiven_(surface.vertices.size(), 0) {}

  Bricks run() {
    place();
    Bricks bricks;
    bricks.grid = grid_;
    for (const uint64_t key : keys()) bricks.add(key);
    bricks.here = {{0}, {uint32_t(bricks.size())}, false};
    group(bricks);
    takeTriangles(bricks);
    return bricks;
  }

 private:
  template <class Item>
  struct Given {
    uint32_t brick;  ///< its number among the changed ones
    Item item;

    auto operator<=>(const Given&) const = default;
  };

  void place() {
    const ClippedTriangles& clipped = parts_.clipped;
    for (uint32_t i = 0; i < clipped.parts.size(); ++i) give(clipped.parts[i].brick, i, givenParts_);
    const size_t hybrid = clipped.hybridEdges.size();
    for (uint32_t i = 0; i < hybrid + surface_.edgesInPlane.size(); ++i) {
      const FaceEdge& edge = faceEdge(surface_, parts_, i);
      grid_.forBricks(edge.element, [&](const Slab& cell) { give(grid_.keyOf(cell), i, edges_); });
      if (i < hybrid) continue;
      for (const VertexId v : {edge.from, edge.to}) {
        const Slab& slab = surface_.vertices.slab(v);
        if (planeCount(slab) > 1 && grid_.isOnSeam(slab)) giveVertex(v);
      }
    }
    for (const VertexId v : clipped.seamVertices) giveVertex(v);
    sortItems(seamVertices_);
  }
  template <class Item>
  void give(uint64_t key, const Item& item, std::vector<Given<Item>>& given) {
    const std::optional<uint32_t> brick = changed_.keys().find(key);
    if (!brick) return;
    given.push_back({*brick, item});
    areTouched_[*brick] = 1;
  }
  /// Triangles around a vertex each have it.
  void giveVertex(VertexId v) {
    if (std::exchange(isGiven_[v], uint8_t(1)) != 0) return;
    grid_.forBricks(surface_.vertices.slab(v), [&](const Slab& cell) {
      const std::optional<uint32_t> brick = changed_.keys().find(grid_.keyOf(cell));
      if (brick) seamVertices_.push_back({*brick, v});
    });
  }

  /// Of all bricks, ascending.
  std::vector<uint64_t> keys() const {
    std::vector<uint64_t> keys;
    for (const uint64_t key : before_.keys) {
      if (!changed_.has(key)) keys.push_back(key);
    }
    for (size_t i = 0; i < areTouched_.size(); ++i) {
      if (areTouched_[i]) keys.push_back(changed_.keys().keys[i]);
    }
    sortItems(keys);
    return keys;
  }

  void group(Bricks& bricks) {
    std::erase_if(seamVertices_, [&](const Given<VertexId>& given) { return !areTouched_[given.brick]; });
    std::vector<BrickId> ids;  // of those that are not touched, any
    for (const uint64_t key : changed_.keys().keys)
      ids.push_back({uint32_t(std::lower_bound(bricks.keys.begin(), bricks.keys.end(), key) - bricks.keys.begin())});
    const auto grouped = [&]<class Item>(const std::vector<Given<Item>>& given) {
      return groupBy<Item, BrickId>(
          bricks.size(), given.size(), [&](size_t i) { return ids[given[i].brick]; }, [&](size_t i) { return given[i].item; });
    };
    bricks.parts = grouped(givenParts_);
    bricks.dividedFaces = grouped(std::vector<Given<FaceId>>());
    bricks.faceEdges = grouped(edges_);
    bricks.seamVertices = grouped(seamVertices_);
  }

  void takeTriangles(Bricks& bricks) const {
    listTriangles(parts_.clipped, bricks);
    BrickId was{0};
    for (const BrickId b : bricks.ids()) {
      while (was.number < before_.size() && before_.keys[was] < bricks.keys[b]) ++was.number;
      if (!changed_.has(bricks.keys[b])) bricks.triangles[b] = std::move(before_.triangles[was]);
    }
  }

  const Surface& surface_;
  const SurfaceParts& parts_;
  const ChangedBricks& changed_;
  Bricks& before_;
  const BrickGrid& grid_;
  std::vector<Given<uint32_t>> givenParts_, edges_;
  std::vector<Given<VertexId>> seamVertices_;
  std::vector<uint8_t> areTouched_;      // per changed brick
  IdVector<VertexId, uint8_t> isGiven_;  // to bricks whose seams it lies on
};

}  // namespace

Bricks layOutAgain(const Surface& surface, const SurfaceParts& parts, const ChangedBricks& changed, Bricks& before) {
  return LayoutAgain(surface, parts, changed, before).run();
}

}  // namespace mandoline::detail
