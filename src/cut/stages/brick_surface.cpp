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
  void addPiece(const Polygon& polygon, const Slab& element) {
    const VertexId past = out_.vertices.firstInTriangle;
    size_t first = 0;
    bool touchesLine = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Corner &a = polygon[i], &b = polygon[first];
      touchesLine |= planeCount(a.slab) > 1;
      if (std::min(a.id, past) != std::min(b.id, past) ? a.id < b.id : a.id >= past && a.slab < b.slab) first = i;
    }
    std::vector<VertexId>& loop = out_.triFaces.loops.items;
    for (size_t i = first; i < polygon.size(); ++i) loop.push_back(polygon[i].id);
    for (size_t i = 0; i < first; ++i) loop.push_back(polygon[i].id);
    endFace(element, touchesLine);
  }

 private:
  void cut(const ClippedTriangles::Part& part) {
    triangle_ = part.triangle;
    if (part.piece != ClippedTriangles::kWhole) {
      const auto piece = parts_.clipped.pieces[part.piece];
      polygon_.assign(piece.begin(), piece.end());
      return dicer_.dice(triangle_, polygon_);
    }
    const auto t = input_.verticesOf(triangle_);
    const Slab &a = input_.slabs[t[0]], &b = input_.slabs[t[1]], &c = input_.slabs[t[2]];
    Slab element;
    bool oneCell = !surface_.edges().hasStitchedSide(triangle_);
    for (size_t d = 0; d < 3; ++d) {
      const int32_t least = std::min({a[d], b[d], c[d]}), greatest = std::max({a[d], b[d], c[d]});
      oneCell &= inOneSlab(least, greatest);
      element[d] = slabBetween(least, greatest);
    }
    if (!oneCell) {
      outlineOf(surface_, triangle_, polygon_);
      return dicer_.dice(triangle_, polygon_);
    }
    std::vector<VertexId>& loop = out_.triFaces.loops.items;
    loop.insert(loop.end(), t.begin(), t.end());
    endFace(element, planeCount(a) > 1 || planeCount(b) > 1 || planeCount(c) > 1);
  }

  void endFace(const Slab& element, bool touchesLine) {
    out_.triFaces.loops.endGroup();
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
  Polygon polygon_;
  Dicer<SurfaceCutter> dicer_;
};

}  // namespace

void cutBrickSurface(const Surface& surface, const SurfaceParts& parts, BrickId brick, Bricks& bricks, BrickSurface& brickSurface) {
  brickSurface.vertices.slabs.clear();
  brickSurface.vertices.parentTriangles.clear();
  brickSurface.triFaces.clear();
  brickSurface.faceEdges.clear();
  SurfaceCutter(surface, parts, brick, bricks, brickSurface).run();
}

}  // namespace mandoline::detail
