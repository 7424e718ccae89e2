#include "cut/stages/bricks.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// Bricks while they are found, numbered in the order in which they are.
class Found {
 public:
  Found(const Input& input, int shift) : slots_(64, kFree) {
    bricks.shift = shift;
    for (size_t d = 0; d < 3; ++d) {
      cells_[d] = input.cells(int(d));
      bricks.counts[d] = ((cells_[d] - 1) >> shift) + 1;
    }
  }

  std::optional<BrickId> find(const Slab& cell) {
    if (bricks.size() > 0 && bricks.boxes[last_].has(cell)) return last_;
    const uint64_t key = bricks.keyOf(cell);
    const uint32_t slot = slots_[slotOf(key)];
    if (slot == kFree) return {};
    return last_ = {slot};
  }
  /// Says that the surface touches a cell of the grid.
  BrickId touch(const Slab& cell) {
    const auto known = find(cell);
    const BrickId brick = known ? *known : add(cell);
    const size_t bit = bricks.firstBit[brick] + bricks.boxes[brick].indexOf(cell);
    bricks.touched[bit / 64] |= uint64_t(1) << bit % 64;
    return brick;
  }

  Bricks bricks;

 private:
  static constexpr uint32_t kFree = ~0u;

  size_t slotOf(uint64_t key) const {
    size_t at = size_t((key * 0x9e3779b97f4a7c15u) >> 32);
    while (slots_[at & (slots_.size() - 1)] != kFree && bricks.keys[{slots_[at & (slots_.size() - 1)]}] != key) ++at;
    return at & (slots_.size() - 1);
  }

  BrickId add(const Slab& cell) {
    const BrickId brick{uint32_t(bricks.size())};
    BrickBox box;
    for (size_t d = 0; d < 3; ++d) {
      box.first[d] = cell[d] >> 1 >> bricks.shift << bricks.shift;
      box.count[d] = std::min(1 << bricks.shift, cells_[d] - box.first[d]);
    }
    const uint64_t key = bricks.keyOf(cell);
    slots_[slotOf(key)] = brick.number;
    bricks.keys.push_back(key);
    bricks.boxes.push_back(box);
    bricks.firstBit.push_back(64 * bricks.touched.size());
    bricks.touched.resize(bricks.touched.size() + (box.size() + 63) / 64, 0);
    if (2 * bricks.size() > slots_.size()) {
      slots_.assign(2 * slots_.size(), kFree);
      for (const BrickId b : bricks.ids()) slots_[slotOf(bricks.keys[b])] = b.number;
    }
    return last_ = brick;
  }

  std::array<int32_t, 3> cells_;
  std::vector<uint32_t> slots_;  // a hash table of bricks by key
  BrickId last_{0};
};

/// Which bricks get which items: nearly all of them one.
template <class Item>
struct Given {
  struct More {
    BrickId brick;
    Item item;
  };
  static constexpr BrickId kNone{~0u};

  std::vector<BrickId> first;  ///< per item, or kNone
  std::vector<More> more;      ///< second ones

  void add(std::optional<BrickId> brick, Item item) {
    const size_t i = indexOf(item);
    if (first.size() == i) return first.push_back(brick.value_or(kNone));
    if (!brick || first[i] == *brick) return;
    if (first[i] == kNone) {
      first[i] = *brick;
    } else {
      more.push_back({*brick, item});
    }
  }
};

class Layout {
 public:
  Layout(const Surface& surface, const TriFaces& faces, int shift)
      : surface_(surface), input_(surface.input), faces_(faces), found_(surface.input, shift) {}

  Bricks run() {
    placeFaces();
    placeEdges();
    placeSeamVertices();
    return sorted();
  }

 private:
  /// Calls f(cell) for the cells of the grid on both sides of a grid-face.
  template <class F>
  void forSides(const Slab& gridFace, const F& f) const {
    const int axis = planeAxis(gridFace);
    for (int side = -1; side <= 1; side += 2) {
      Slab cell = gridFace;
      cell[size_t(axis)] += side;
      if (input_.inGrid(cell)) f(cell);
    }
  }
  void placeFaces() {
    givenFaces_.first.reserve(faces_.size());
    for (const FaceId f : faces_.ids()) {
      const Slab& element = faces_.elements[f];
      if (planeCount(element) == 0) {
        givenFaces_.first.push_back(found_.touch(element));
      } else {
        forSides(element, [&](const Slab& cell) { givenFaces_.add(found_.touch(cell), f); });
      }
      if (!faces_.touchesLine[f] || !isBesideSeam(element)) continue;
      for (const auto loop : faces_.loopsOf(f)) {
        for (const VertexId v : loop) noteSeamVertex(v);
      }
    }
  }

  void placeEdges() {
    const uint32_t hybrid = uint32_t(faces_.hybridEdges.size()), all = hybrid + uint32_t(surface_.edgesInPlane.size());
    givenEdges_.first.reserve(all);
    for (uint32_t i = 0; i < all; ++i) {
      const FaceEdge& edge = faceEdge(surface_, faces_, i);
      const int axis = planeAxis(edge.element);
      if (i < hybrid && edge.element[size_t(axis)] > 0 && !isOnSeam(edge.element, axis)) {  // both sides lie in one brick, which has it
        Slab cell = edge.element;
        --cell[size_t(axis)];
        givenEdges_.add(found_.find(cell), i);
        continue;
      }
      forSides(edge.element, [&](const Slab& cell) { givenEdges_.add(i < hybrid ? found_.find(cell) : found_.touch(cell), i); });
      if (i < hybrid) continue;
      noteSeamVertex(edge.from);
      noteSeamVertex(edge.to);
    }
  }

  bool isBesideSeam(const Slab& element) const {
    const int32_t others = (2 << found_.bricks.shift) - 1;
    bool isBeside = false;
    for (const int32_t slab : element) isBeside |= ((slab + 1) & others) <= 2;
    return isBeside;
  }

  bool isOnSeam(const Slab& slab, int axis) const {
    const int32_t others = (2 << found_.bricks.shift) - 1;
    return (slab[size_t(axis)] & others) == 0 && slab[size_t(axis)] > 0 && slab[size_t(axis)] < 2 * input_.cells(axis);
  }

  void noteSeamVertex(VertexId v) {
    const Slab& slab = surface_.vertices.slabs[v];
    if (planeCount(slab) < 2 || !(isOnSeam(slab, 0) || isOnSeam(slab, 1) || isOnSeam(slab, 2))) return;
    seamVertices_.push_back(v);
  }

  void placeSeamVertices() {
    sortUnique(seamVertices_);
    for (const VertexId v : seamVertices_) {
      const Slab& slab = surface_.vertices.slabs[v];
      for (int corner = 0; corner < 8; ++corner) {  // of the cells that have it, one of each brick
        Slab cell = slab;
        bool isNew = true;
        for (int d = 0; d < 3; ++d) {
          const int side = corner >> d & 1;
          if (onPlane(slab[size_t(d)])) cell[size_t(d)] += side == 1 || slab[size_t(d)] == 0 ? 1 : -1;
          isNew &= side == 0 || isOnSeam(slab, d);
        }
        const auto brick = isNew ? found_.find(cell) : std::nullopt;
        if (brick) givenVertices_.push_back({*brick, v});
      }
    }
  }

  /// With bricks in their order.
  Bricks sorted() {
    Bricks& found = found_.bricks;
    std::vector<BrickId> order;
    for (const BrickId b : found.ids()) order.push_back(b);
    sortItems(order, [&](BrickId a, BrickId b) { return found.keys[a] < found.keys[b]; });
    IdVector<BrickId, BrickId> newIds(order.size());
    Bricks bricks;
    bricks.shift = found.shift;
    bricks.counts = found.counts;
    bricks.touched = std::move(found.touched);
    for (uint32_t i = 0; i < order.size(); ++i) {
      newIds[order[i]] = {i};
      bricks.keys.push_back(found.keys[order[i]]);
      bricks.boxes.push_back(found.boxes[order[i]]);
      bricks.firstBit.push_back(found.firstBit[order[i]]);
    }
    bricks.triFaces = grouped(givenFaces_, newIds);
    bricks.faceEdges = grouped(givenEdges_, newIds);
    bricks.seamVertices = groupBy<VertexId, BrickId>(
        newIds.size(), givenVertices_.size(), [&](size_t i) { return newIds[givenVertices_[i].brick]; },
        [&](size_t i) { return givenVertices_[i].item; });
    return bricks;
  }

  template <class Item>
  static Csr<Item, BrickId> grouped(const Given<Item>& given, const IdVector<BrickId, BrickId>& newIds) {
    const size_t firsts = given.first.size();
    const auto brickOf = [&](size_t i) {
      const BrickId brick = i < firsts ? given.first[i] : given.more[i - firsts].brick;
      return brick == Given<Item>::kNone ? BrickId{uint32_t(newIds.size())} : newIds[brick];
    };
    const auto itemOf = [&](size_t i) { return i < firsts ? Item{uint32_t(i)} : given.more[i - firsts].item; };
    Csr<Item, BrickId> groups = groupBy<Item, BrickId>(newIds.size() + 1, firsts + given.more.size(), brickOf, itemOf);
    groups.offsets.pop_back();  // those that no brick has
    return groups;
  }

  const Surface& surface_;
  const Input& input_;
  const TriFaces& faces_;
  Found found_;
  Given<FaceId> givenFaces_;
  Given<uint32_t> givenEdges_;
  std::vector<Given<VertexId>::More> givenVertices_;
  std::vector<VertexId> seamVertices_;
};

/// The number of grid vertices that the touched cells of a brick have.
size_t countGridVertices(const Bricks& bricks, BrickId brick) {
  const BrickBox& box = bricks.boxes[brick];
  const size_t nx = size_t(box.count[0]) + 1, ny = size_t(box.count[1]) + 1, nz = size_t(box.count[2]) + 1;
  std::vector<uint8_t> has(nx * ny * nz, 0);
  bricks.forTouched(brick, [&](uint32_t i) {
    const size_t x = i % uint32_t(box.count[0]), row = i / uint32_t(box.count[0]);
    const size_t at = (row / uint32_t(box.count[1]) * ny + row % uint32_t(box.count[1])) * nx + x;
    for (const size_t corner : {at, at + 1, at + nx, at + nx + 1}) has[corner] = has[corner + nx * ny] = 1;
  });
  return size_t(std::count(has.begin(), has.end(), uint8_t(1)));
}

}  // namespace

std::optional<BrickId> Bricks::findTouched(const Slab& cell) const {
  const uint64_t key = keyOf(cell);
  const auto found = std::lower_bound(keys.begin(), keys.end(), key);
  if (found == keys.end() || *found != key) return {};
  const BrickId brick{uint32_t(found - keys.begin())};
  if (!isTouched(brick, boxes[brick].indexOf(cell))) return {};
  return brick;
}

Bricks layOutBricks(Surface& surface, const TriFaces& faces, const Run& run) {
  Bricks bricks = Layout(surface, faces, run.brickShift).run();
  CutVertices& vertices = surface.vertices;
  size_t total = vertices.size();
  for (const BrickId b : bricks.ids()) {
    bricks.firstOnGrid.push_back({uint32_t(total)});
    total += countGridVertices(bricks, b);
    if (total > size_t(1) << 31) throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices."}};
  }
  vertices.slabs.resize(total);
  return bricks;
}

}  // namespace mandoline::detail
