#include "cut/stages/brick_surface.h"

#include "base/disjoint_sets.h"
#include "base/prefetch.h"
#include "cut/stages/dicer.h"

namespace mandoline::detail {
namespace {

/// The number of tri-cut-faces of so many triangles, as far as the surface's crossings tell it.
size_t aboutAsMany(const Surface& surface, size_t triangles) {
  const double edges = double(surface.edges().ends.size());
  const double crossings = double(surface.vertices.firstInTriangle.number - surface.vertices.firstOnEdge.number) / std::max(edges, 1.0);
  return size_t(double(triangles) * std::min(1 + 2 * crossings, 16.0));
}

class SurfaceCutter {
 public:
  SurfaceCutter(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& out)
      : surface_(surface),
        input_(surface.input),
        slabs_(surface.vertices.slabs.data()),
        parts_(parts),
        brick_(brick),
        bricks_(bricks),
        box_(bricks.boxes[brick]),
        touched_(bricks.wordsOf(brick)),
        out_(out),
        faces_(out.triFaces, aboutAsMany(surface, bricks.parts[brick].size())),
        dicer_(input_, nullptr, *this) {
    dicer_.onlySweep = out.onlySweep;
  }
  SurfaceCutter(const SurfaceCutter&) = delete;

  void run() {
    const auto parts = bricks_.parts[brick_];
    const ClippedTriangles::Part* const all = parts_.clipped.parts.data();
    for (size_t begin = 0; begin < parts.size(); begin += kAhead) {
      const size_t past = std::min(begin + kAhead, parts.size());
      for (size_t i = begin; i < past; ++i) prefetchOf(parts, i);
      for (size_t i = begin; i < past; ++i) cut(all[parts[i]]);
    }
    faces_.end();
    out_.inner.listFloating(out_.specialFaces);
    for (const FaceId f : bricks_.dividedFaces[brick_]) {
      out_.specialFaces.push_back({uint32_t(out_.triFaces.size())});
      if (parts_.divided.touchesLine[f]) out_.onGridLines.push_back(out_.specialFaces.back());
      out_.triFaces.append(parts_.divided, f);
      touch(parts_.divided.elements[f]);
    }
    addFaceEdges();
    out_.seamVertices = bricks_.seamVertices[brick_];
    out_.predicates.fallbacks += dicer_.predicates.fallbacks;
  }

  // For the dicer.
  VertexId addVertex(const Slab& slab) {
    isPlain_ &= planeCount(slab) == 2;
    return out_.vertices.add(slab, triangle_);
  }
  void addHybridEdge(const FaceEdge& edge) { out_.faceEdges.push_back(edge); }
  /// A loop begins with its lowest vertex of the mesh, or of a tri-edge; without one, with that of the lowest slabs.
  void addPiece(Polygon polygon, const Slab& element) {
    const VertexId firstInTriangle = out_.vertices.firstInTriangle;
    uint64_t lowest = ~uint64_t(0);  // with its place in the lower bits
    VertexId highest{0};
    for (size_t i = 0; i < polygon.size(); ++i) {
      lowest = std::min(lowest, uint64_t(polygon[i].id.number) << 32 | i);
      highest = std::max(highest, polygon[i].id);
    }
    size_t first = uint32_t(lowest);
    if (polygon[first].id >= firstInTriangle) {
      const auto bySlab = [](const Corner& a, const Corner& b) { return a.slab < b.slab; };
      first = size_t(std::min_element(polygon.begin(), polygon.end(), bySlab) - polygon.begin());
    }
    VertexId* const loop = faces_.makeLoop(polygon.size());
    writeIds(&polygon[first], polygon.size() - first, loop);
    writeIds(&polygon[0], first, loop + (polygon.size() - first));
    const bool isPlain = isPlain_ && !isStitched_ && !isUnpaired_;
    endFace(polygon.size(), element, isPlain ? OnPlanes{highest >= firstInTriangle} : onPlanes(polygon));
  }

 private:
  /// What a tri-cut-face has on axial planes.
  struct OnPlanes {
    bool touchesLine = false, surfaceTouchesLine = false;  ///< whether a vertex lies on a grid line, and one that is not the brick's own
    bool isSpecial = false;                                ///< see PartedCell
  };
  static constexpr bool kInGrid = true;  // nothing of a part lies outside
  static constexpr size_t kAhead = 16;   // parts, while what is known of one comes from memory

  /// What later ones need, each time a step further. Of many in a row, since WebAssembly waits for what it reads, but for several at once.
  template <class Parts>
  void prefetchOf(const Parts& parts, size_t i) const {
    const ClippedTriangles::Part* const all = parts_.clipped.parts.data();
    if (i + 4 * kAhead < parts.size()) prefetch(all + parts[i + 4 * kAhead]);
    if (i + 3 * kAhead < parts.size()) prefetchTriangle(all[parts[i + 3 * kAhead]].triangle);
    if (i + 2 * kAhead < parts.size()) prefetchCorners(all[parts[i + 2 * kAhead]]);
    if (i + kAhead < parts.size()) prefetchCrossings(all[parts[i + kAhead]]);
  }
  void prefetchTriangle(TriangleId triangle) const {
    prefetch(&input_.mesh->triangles[triangle.number]);
    prefetch(&surface_.edges().sideEdges[3 * size_t(triangle.number)]);
  }
  void prefetchCorners(const ClippedTriangles::Part& part) const {
    if (part.piece != ClippedTriangles::kWhole) return prefetch(&parts_.clipped.pieces.offsets[part.piece]);
    for (const VertexId v : input_.verticesOf(part.triangle)) prefetch(&slabs_[v.number]);
    forSides(part.triangle, [&](const VertexId* offset) { prefetch(offset); });
  }
  void prefetchCrossings(const ClippedTriangles::Part& part) const {
    if (part.piece == ClippedTriangles::kWhole) {
      forSides(part.triangle, [&](const VertexId* offset) { prefetch(slabs_ + offset->number); });
    } else {
      const Polygon piece = parts_.clipped.pieces[part.piece];
      prefetch(&piece.front());
      prefetch(&piece.back());
    }
  }
  /// Calls f(offset) for those of the crossings on its sides, but for stitched ones.
  template <class F>
  void forSides(TriangleId triangle, const F& f) const {
    const uint32_t* sides = &surface_.edges().sideEdges[3 * size_t(triangle.number)];
    const VertexId* offsets = surface_.vertices.crossingOffsets.data();
    for (size_t i = 0; i < 3; ++i) {
      if (sides[i] < MeshEdges::kStitched) f(offsets + sides[i]);
    }
  }

  void cut(const ClippedTriangles::Part& part) {
    triangle_ = part.triangle;
    isStitched_ = surface_.edges().hasStitchedSide(triangle_);
    isUnpaired_ = !surface_.unpaired.empty() && surface_.unpaired[triangle_] != 0;
    if (part.piece != ClippedTriangles::kWhole) {
      const Polygon piece = parts_.clipped.pieces[part.piece];
      outline_.clear();
      outline_.makeRoom(piece.size());
      for (const Corner& c : piece) outline_.add(c);
      isPlain_ = false;
      out_.inner.addOther(triangle_);
      return dicer_.dice(triangle_, outline_.all(), Extent::of(piece), kInGrid);
    }
    const auto t = input_.verticesOf(triangle_);
    const Slab &a = slabs_[t[0].number], &b = slabs_[t[1].number], &c = slabs_[t[2].number];
    const Extent extent = Extent::of(a, b, c);
    if (!extent.isOneElement() || isStitched_) {
      out_.inner.addOther(triangle_);
      outlineOf(surface_, triangle_, outline_);
      isPlain_ = surface_.isPlain || isPlain(outline_.all());
      return dicer_.dice(triangle_, outline_.all(), extent, kInGrid);
    }
    std::copy_n(t.data(), 3, faces_.makeLoop(3));
    const int planes = std::max({planeCount(a), planeCount(b), planeCount(c)});
    const bool isSpecial = planes > 0 || isUnpaired_;
    const FaceId face = endFace(3, extent.element(), {planes > 1, planes > 1, isSpecial});
    if (!isSpecial) out_.inner.add(face, triangle_);
  }

  /// Whether those of the outline that are of the mesh lie on no plane, and the others, on tri-edges, on one each.
  bool isPlain(Polygon outline) const {
    size_t onPlanes = 0, onEdges = 0;
    for (const Corner& c : outline) {
      onPlanes += size_t(planeCount(c.slab));
      onEdges += c.id >= out_.vertices.firstOnEdge;
    }
    return onPlanes == onEdges;
  }

  bool hasWholeEdge(Polygon polygon) const {
    for (size_t i = 0; i < polygon.size(); ++i) {
      const VertexId next = polygon[i + 1 < polygon.size() ? i + 1 : 0].id;
      if (std::max(polygon[i].id, next) < out_.vertices.firstOnEdge) return true;
    }
    return false;
  }

  OnPlanes onPlanes(Polygon polygon) const {
    const CutVertices& vertices = out_.vertices;
    OnPlanes on;
    on.isSpecial = isStitched_ || (isUnpaired_ && hasWholeEdge(polygon));
    for (const Corner& c : polygon) {
      const int planes = planeCount(c.slab);
      on.touchesLine |= planes > 1;
      on.surfaceTouchesLine |= planes > 1 && c.id < vertices.firstOwn;
      on.isSpecial |= planes > (c.id >= vertices.firstOnEdge) + (c.id >= vertices.firstInTriangle);
    }
    return on;
  }

  /// Those that are not diced here.
  void addFaceEdges() {
    const size_t hybrid = parts_.clipped.hybridEdges.size() + parts_.divided.hybridEdges.size();
    const auto all = bricks_.faceEdges[brick_];
    const auto firstTriEdge = std::lower_bound(all.begin(), all.end(), hybrid);
    for (const uint32_t i : all) out_.faceEdges.push_back(faceEdge(surface_, parts_, i));
    out_.firstTriEdge = out_.faceEdges.size() - size_t(all.end() - firstTriEdge);
    for (size_t i = out_.firstTriEdge; i < out_.faceEdges.size(); ++i) touch(out_.faceEdges[i].element);
  }

  /// Block by block, since how many there are can't be foretold.
  static void writeIds(const Corner* corners, size_t count, VertexId* to) {
    static_assert(CornerRow::kBlock == TriFaceWriter::kBlock);
    size_t i = 0;
    do {
      for (size_t k = i; k < i + CornerRow::kBlock; ++k) to[k] = corners[k].id;
      i += CornerRow::kBlock;
    } while (i < count);
  }

  FaceId endFace(size_t vertices, const Slab& element, const OnPlanes& on) {
    const FaceId face = faces_.endFace(vertices, triangle_, element, on.touchesLine);
    if (on.isSpecial) out_.specialFaces.push_back(face);
    if (on.surfaceTouchesLine) out_.onGridLines.push_back(face);
    touch(element);
    return face;
  }

  /// The cells that have a grid element, of those in the brick.
  void touch(const Slab& element) {
    if (isCell(element)) return touchCell(element);
    findCellAround(element, [&](const Slab& cell) {
      if (box_.has(cell)) touchCell(cell);
      return false;
    });
  }
  void touchCell(const Slab& cell) {
    const uint32_t index = box_.indexOf(cell);
    touched_[index / 64] |= uint64_t(1) << index % 64;
  }

  const Surface& surface_;
  const Input& input_;
  const Slab* const slabs_;  // of the surface's vertices
  const SurfaceParts& parts_;
  const BrickId brick_;
  const Bricks& bricks_;
  const BrickBox box_;
  const std::span<uint64_t> touched_;  // its words
  BrickSurface& out_;
  TriFaceWriter faces_;
  TriangleId triangle_{0};
  bool isStitched_ = false;  // whether vertices are stitched into its sides
  bool isUnpaired_ = false;  // see Surface
  bool isPlain_ = false;     // whether all its vertices so far lie on the planes that they are made by alone, and all in it are the brick's
  CornerRow outline_;
  Dicer<SurfaceCutter> dicer_;
};

}  // namespace

void InnerTriangles::addOther(TriangleId triangle) {
  const uint32_t* sides = sidesOf(triangle);
  for (size_t i = 0; i < 3; ++i) {
    if (sides[i] < MeshEdges::kStitched) isReached_[{sides[i]}] = 1;
  }
}

void InnerTriangles::listFloating(std::vector<FaceId>& faces) {
  size_t before;
  do {
    before = items_.size();
    dropNear();
  } while (items_.size() < before / 2);
  if (!items_.empty()) dropConnected();
  for (const Item& item : items_) faces.push_back(item.face);
}

/// Those that have a tri-edge that is reached.
void InnerTriangles::dropNear() {
  uint8_t* const isReached = isReached_.data();
  size_t left = 0;
  for (const Item item : items_) {
    const uint32_t* sides = sidesOf(item.triangle);
    const uint32_t a = sides[0], b = sides[1], c = sides[2];
    const uint8_t reached = isReached[a] | isReached[b] | isReached[c];
    isReached[a] = isReached[b] = isReached[c] = reached;
    items_[left] = item;  // no branch on what can't be foretold
    left += 1 - reached;
  }
  items_.resize(left);
}

void InnerTriangles::dropConnected() {
  struct Use {
    uint32_t edge;
    Id<Item> item;
  };
  IdSets<Id<Item>> sets;
  sets.reset(items_.size() + 1);
  const Id<Item> reached{uint32_t(items_.size())};
  std::vector<Use> uses;
  for (uint32_t i = 0; i < items_.size(); ++i) {
    for (size_t side = 0; side < 3; ++side) uses.push_back({sidesOf(items_[i].triangle)[side], {i}});
  }
  sortItems(uses, [](const Use& a, const Use& b) { return a.edge < b.edge; });
  for (size_t k = 0; k < uses.size(); ++k) {
    if (isReached_[{uses[k].edge}]) sets.unite(uses[k].item, reached);
    if (k > 0 && uses[k - 1].edge == uses[k].edge) sets.unite(uses[k - 1].item, uses[k].item);
  }
  size_t left = 0;
  for (uint32_t i = 0; i < items_.size(); ++i) {
    if (sets.find({i}) != sets.find(reached)) items_[left++] = items_[i];
  }
  items_.resize(left);
}

void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface) {
  brickSurface.vertices.slabs.clear();
  brickSurface.vertices.parentTriangles.clear();
  brickSurface.specialFaces.clear();
  brickSurface.onGridLines.clear();
  brickSurface.faceEdges.clear();
  brickSurface.inner.begin(surface.edges());
  if (brickSurface.faceEdges.capacity() == 0) {  // about as many, of the first brick, which is the heaviest
    const size_t triangles = bricks.parts[brick].size(), cutOff = aboutAsMany(surface, triangles) - triangles;
    brickSurface.faceEdges.reserve(2 * cutOff);
    brickSurface.vertices.slabs.reserve(cutOff);
    brickSurface.vertices.parentTriangles.reserve(cutOff);
  }
  SurfaceCutter(surface, parts, brick, bricks, brickSurface).run();
}

}  // namespace mandoline::detail
