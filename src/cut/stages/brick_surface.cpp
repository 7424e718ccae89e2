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
      out_.triFaces.append(parts_.divided, f);
      touch(parts_.divided.elements[f]);
    }
    const size_t hybrid = parts_.clipped.hybridEdges.size() + parts_.divided.hybridEdges.size();
    for (const uint32_t i : bricks_.faceEdges[brick_]) {
      out_.faceEdges.push_back(faceEdge(surface_, parts_, i));
      if (i >= hybrid) touch(out_.faceEdges.back().element);
    }
    out_.seamVertices = bricks_.seamVertices[brick_];
    out_.predicates.fallbacks += dicer_.predicates.fallbacks;
  }

  // For the dicer.
  VertexId addVertex(const Slab& slab) { return out_.vertices.add(slab, triangle_); }
  void addHybridEdge(const FaceEdge& edge) { out_.faceEdges.push_back(edge); }
  /// A loop begins with its lowest vertex of the mesh, or of a tri-edge; without one, with that of the lowest slabs.
  void addPiece(Polygon polygon, const Slab& element) {
    const CutVertices& vertices = out_.vertices;
    uint64_t lowest = ~uint64_t(0);  // with its place in the lower bits
    bool touchesLine = false, isSpecial = isStitched_;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const VertexId v = polygon[i].id;
      const int planes = planeCount(polygon[i].slab);
      lowest = std::min(lowest, uint64_t(v.number) << 32 | i);
      touchesLine |= planes > 1;
      isSpecial |= planes > (v >= vertices.firstOnEdge) + (v >= vertices.firstInTriangle);
    }
    size_t first = uint32_t(lowest);
    if (polygon[first].id >= vertices.firstInTriangle) {
      const auto bySlab = [](const Corner& a, const Corner& b) { return a.slab < b.slab; };
      first = size_t(std::min_element(polygon.begin(), polygon.end(), bySlab) - polygon.begin());
    }
    VertexId* const loop = faces_.makeLoop(polygon.size());
    writeIds(&polygon[first], polygon.size() - first, loop);
    writeIds(&polygon[0], first, loop + (polygon.size() - first));
    endFace(polygon.size(), element, touchesLine, isSpecial);
  }

 private:
  static constexpr bool kInGrid = true;  // nothing of a part lies outside

  void cut(const ClippedTriangles::Part& part) {
    triangle_ = part.triangle;
    isStitched_ = surface_.edges().hasStitchedSide(triangle_);
    if (part.piece != ClippedTriangles::kWhole) {
      const Polygon piece = parts_.clipped.pieces[part.piece];
      outline_.clear();
      outline_.makeRoom(piece.size());
      for (const Corner& c : piece) outline_.add(c);
      return dicer_.dice(triangle_, outline_.all(), Extent::of(piece), kInGrid);
    }
    const auto t = input_.verticesOf(triangle_);
    const Slab &a = input_.slabs[t[0]], &b = input_.slabs[t[1]], &c = input_.slabs[t[2]];
    const Extent extent = Extent::of(a, b, c);
    if (!extent.isOneElement() || isStitched_) {
      outlineOf(surface_, triangle_, outline_);
      return dicer_.dice(triangle_, outline_.all(), extent, kInGrid);
    }
    std::copy_n(t.data(), 3, faces_.makeLoop(3));
    const int planes = std::max({planeCount(a), planeCount(b), planeCount(c)});
    endFace(3, extent.element(), planes > 1, planes > 0);
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

  void endFace(size_t vertices, const Slab& element, bool touchesLine, bool isSpecial) {
    const FaceId face = faces_.endFace(vertices, triangle_, element, touchesLine);
    if (isSpecial) out_.specialFaces.push_back(face);
    touch(element);
  }

  /// The cells that have a grid element, of those in the brick.
  void touch(const Slab& element) {
    if (isCell(element)) return bricks_.touch(brick_, element);
    findCellAround(element, [&](const Slab& cell) {
      if (bricks_.boxes[brick_].has(cell)) bricks_.touch(brick_, cell);
      return false;
    });
  }

  const Surface& surface_;
  const Input& input_;
  const SurfaceParts& parts_;
  const BrickId brick_;
  Bricks& bricks_;
  BrickSurface& out_;
  TriFaceWriter faces_;
  TriangleId triangle_{0};
  bool isStitched_ = false;  // whether vertices are stitched into its sides
  CornerRow outline_;
  Dicer<SurfaceCutter> dicer_;
};

}  // namespace

void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface) {
  brickSurface.vertices.slabs.clear();
  brickSurface.vertices.parentTriangles.clear();
  brickSurface.triFaces.clear();
  brickSurface.specialFaces.clear();
  brickSurface.faceEdges.clear();
  SurfaceCutter(surface, parts, brick, bricks, brickSurface).run();
}

}  // namespace mandoline::detail
