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
        dicer_(input_, BrickGrid::same(0), *this) {}
  SurfaceCutter(const SurfaceCutter&) = delete;

  void run() {
    for (const uint32_t i : bricks_.parts[brick_]) cut(parts_.clipped.parts[i]);
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
    size_t first = 0;
    bool touchesLine = false, isSpecial = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const int planes = planeCount(polygon[i].slab);
      touchesLine |= planes > 1;
      isSpecial |= planes > (polygon[i].id >= vertices.firstOnEdge) + (polygon[i].id >= vertices.firstInTriangle);
      if (polygon[i].id < polygon[first].id) first = i;
    }
    if (polygon[first].id >= vertices.firstInTriangle) {
      const auto lowest =
          std::min_element(polygon.begin(), polygon.end(), [](const Corner& a, const Corner& b) { return a.slab < b.slab; });
      first = size_t(lowest - polygon.begin());
    }
    std::vector<VertexId>& loop = out_.triFaces.loops.items;
    for (size_t i = first; i < polygon.size(); ++i) loop.push_back(polygon[i].id);
    for (size_t i = 0; i < first; ++i) loop.push_back(polygon[i].id);
    endFace(element, touchesLine, isSpecial);
  }

 private:
  static constexpr bool kInGrid = true;  // nothing of a part lies outside

  void cut(const ClippedTriangles::Part& part) {
    triangle_ = part.triangle;
    if (part.piece != ClippedTriangles::kWhole) {
      const Polygon piece = parts_.clipped.pieces[part.piece];
      return dicer_.dice(triangle_, piece, Extent::of(piece), kInGrid);
    }
    const auto t = input_.verticesOf(triangle_);
    const Slab &a = input_.slabs[t[0]], &b = input_.slabs[t[1]], &c = input_.slabs[t[2]];
    const Extent extent = Extent::of(a, b, c);
    if (!extent.isOneElement() || surface_.edges().hasStitchedSide(triangle_)) {
      outlineOf(surface_, triangle_, outline_);
      return dicer_.dice(triangle_, outline_.all(), extent, kInGrid);
    }
    std::vector<VertexId>& loop = out_.triFaces.loops.items;
    for (const VertexId v : t) loop.push_back(v);
    const int planes = std::max({planeCount(a), planeCount(b), planeCount(c)});
    endFace(extent.element(), planes > 1, planes > 0);
  }

  void endFace(const Slab& element, bool touchesLine, bool isSpecial) {
    out_.triFaces.loops.endGroup();
    if (isSpecial) out_.specialFaces.push_back({uint32_t(out_.triFaces.size())});
    out_.triFaces.endFace(triangle_, element, touchesLine);
    touch(element);
  }

  /// The cells that have a grid element, of those in the brick.
  void touch(const Slab& element) {
    if (planeCount(element) == 0) return bricks_.touch(brick_, element);
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
  TriangleId triangle_{0};
  Corners outline_;
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
