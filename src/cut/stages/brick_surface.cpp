#include "cut/stages/brick_surface.h"

#include "cut/stages/dicer.h"

namespace mandoline::detail {
namespace {

class SurfaceCutter {
 public:
  SurfaceCutter(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& out)
      : surface_(surface),
        input_(surface.input),
        parts_(parts),
        brick_(brick),
        bricks_(bricks),
        box_(bricks.boxes[brick]),
        touched_(bricks.wordsOf(brick)),
        out_(out),
        faces_(out.triFaces, 2 * bricks.parts[brick].size()),
        dicer_(input_, BrickGrid::same(0), *this) {
    dicer_.onlySweep = out.onlySweep;
  }
  SurfaceCutter(const SurfaceCutter&) = delete;

  void run() {
    for (const uint32_t i : bricks_.parts[brick_]) cut(parts_.clipped.parts[i]);
    faces_.end();
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
    const bool isPlain = isPlain_ && !isStitched_;
    endFace(polygon.size(), element, isPlain ? OnPlanes{highest >= firstInTriangle} : onPlanes(polygon));
  }

 private:
  /// What a tri-cut-face has on axial planes.
  struct OnPlanes {
    bool touchesLine = false, surfaceTouchesLine = false;  ///< whether a vertex lies on a grid line, and one that is not the brick's own
    bool isSpecial = false;                                ///< see PartedCell
  };
  static constexpr bool kInGrid = true;  // nothing of a part lies outside

  void cut(const ClippedTriangles::Part& part) {
    triangle_ = part.triangle;
    isStitched_ = surface_.edges().hasStitchedSide(triangle_);
    if (part.piece != ClippedTriangles::kWhole) {
      const Polygon piece = parts_.clipped.pieces[part.piece];
      outline_.clear();
      outline_.makeRoom(piece.size());
      for (const Corner& c : piece) outline_.add(c);
      isPlain_ = false;
      return dicer_.dice(triangle_, outline_.all(), Extent::of(piece), kInGrid);
    }
    const auto t = input_.verticesOf(triangle_);
    const Slab &a = input_.slabs[t[0]], &b = input_.slabs[t[1]], &c = input_.slabs[t[2]];
    const Extent extent = Extent::of(a, b, c);
    if (!extent.isOneElement() || isStitched_) {
      outlineOf(surface_, triangle_, outline_);
      isPlain_ = surface_.isPlain || isPlain(outline_.all());
      return dicer_.dice(triangle_, outline_.all(), extent, kInGrid);
    }
    std::copy_n(t.data(), 3, faces_.makeLoop(3));
    const int planes = std::max({planeCount(a), planeCount(b), planeCount(c)});
    endFace(3, extent.element(), {planes > 1, planes > 1, planes > 0});
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

  OnPlanes onPlanes(Polygon polygon) const {
    const CutVertices& vertices = out_.vertices;
    OnPlanes on;
    on.isSpecial = isStitched_;
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

  void endFace(size_t vertices, const Slab& element, const OnPlanes& on) {
    const FaceId face = faces_.endFace(vertices, triangle_, element, on.touchesLine);
    if (on.isSpecial) out_.specialFaces.push_back(face);
    if (on.surfaceTouchesLine) out_.onGridLines.push_back(face);
    touch(element);
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
  const SurfaceParts& parts_;
  const BrickId brick_;
  const Bricks& bricks_;
  const BrickBox box_;
  const std::span<uint64_t> touched_;  // its words
  BrickSurface& out_;
  TriFaceWriter faces_;
  TriangleId triangle_{0};
  bool isStitched_ = false;  // whether vertices are stitched into its sides
  bool isPlain_ = false;     // whether all its vertices so far lie on the planes that they are made by alone, and all in it are the brick's
  CornerRow outline_;
  Dicer<SurfaceCutter> dicer_;
};

}  // namespace

void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface) {
  brickSurface.vertices.slabs.clear();
  brickSurface.vertices.parentTriangles.clear();
  brickSurface.specialFaces.clear();
  brickSurface.onGridLines.clear();
  brickSurface.faceEdges.clear();
  SurfaceCutter(surface, parts, brick, bricks, brickSurface).run();
}

}  // namespace mandoline::detail
