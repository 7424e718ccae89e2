#include "cut/stages/grid_faces.h"

#include "base/appender.h"
#include "cut/stages/one_chain.h"

namespace mandoline::detail {
namespace {

/// How much there may be at most: each cut-edge adds a piece or a loop at most, and has one vertex of loops on either side.
struct Most {
  size_t gridFaces, faces, loopVertices, beside;

  Most(const Stencil& stencil, const GridEdges& gridEdges) {
    const size_t edges = stencil.edgesOnFace.items.size();
    gridFaces = stencil.faces.size();
    faces = gridFaces + edges;
    loopVertices = 4 * (gridFaces + gridEdges.vertices.items.size()) + 2 * edges;  // a grid-edge has four grid-faces
    beside = loopVertices + 5 * gridFaces;
  }
};

class FaceCutter {
 public:
  FaceCutter(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, GridFaceScratch& scratch, GridFaces& faces)
      : input_(surface.input),
        stencil_(stencil),
        gridEdges_(gridEdges),
        triFaces_(surface.triFaces),
        vertices_(surface.vertices),
        scratch_(scratch),
        faces_(faces),
        most_(stencil, gridEdges),
        loopVertices_(faces.loops.items, most_.loopVertices + kAppendedBlock),
        pastLoopVertex_(faces.loops.offsets, most_.faces + 1),
        pastLoop_(faces.faceLoopOffsets, most_.faces + 1),
        gridFaceOf_(faces.gridFaces, most_.faces),
        halfFaces_(faces.halfFaces.items, most_.faces + stencil.triFacesOnFace.items.size()),
        pastHalfFace_(faces.halfFaces.offsets, most_.gridFaces + 1),
        pastSlit_(faces.slits.offsets, most_.gridFaces + 1),
        beside_(faces.beside.items, most_.beside),
        pastBeside_(faces.beside.offsets, most_.gridFaces + 1),
        kinds_(faces.kinds, most_.gridFaces) {
    for (Appender<uint32_t>* offsets : {&pastLoopVertex_, &pastLoop_, &pastHalfFace_, &pastSlit_, &pastBeside_}) offsets->add(0);
    faces.slits.items.clear();
    scratch.outline.resize(4 + gridEdges.vertices.items.size() + kAppendedBlock);
  }

  void cut(GridFaceId gridFace) {
    kinds_.add(cutAs(gridFace));
    pastHalfFace_.add(uint32_t(halfFaces_.size()));
    pastSlit_.add(uint32_t(faces_.slits.items.size()));
    pastBeside_.add(uint32_t(beside_.size()));
  }

 private:
  GridFaceKind cutAs(GridFaceId gridFace) {
    const auto edges = stencil_.edgesOnFace[gridFace];
    const auto triFaces = stencil_.triFacesOnFace[gridFace];
    const std::span<const VertexId> outline = findOutline(stencil_.faces[gridFace]);
    if (edges.empty() && triFaces.empty()) {
      addPiece(gridFace, [&](const auto& add) { add(outline.data(), outline.size()); });
      return GridFaceKind::whole;
    }
    const bool mayChain = !scratch_.onlyGraph && triFaces.empty();
    const bool hasTwo = outline.size() == 4 + betweenCorners_.size();
    if (mayChain && ((hasTwo && chain_.findBetween(betweenCorners_, outline, edges)) || chain_.find(outline, edges))) {
      addChained(gridFace, outline, edges.size());
      return GridFaceKind::chains;
    }
    PlanarGraph& graph = scratch_.graph;
    graph.begin(vertices_, stencil_.faces[gridFace].axis());
    graph.setOutline(outline);
    for (const EdgeOnFace& e : edges) graph.addEdge(e.from, e.to);
    if (mayChain && graph.traceChains(scratch_.chains)) {
      addChained(gridFace, outline.size());
      return GridFaceKind::chains;
    }
    cutByGraph(gridFace);
    return GridFaceKind::graph;
  }

  /// The vertices on the sides, counter-clockwise about the axis.
  std::span<const VertexId> findOutline(const Stencil::Face& face) {
    const Stencil::Cell& cell = stencil_.cells[face.cell];
    const Outline& outline = kOutlines[face.index];
    VertexId *const begin = scratch_.outline.data(), *end = begin;
    for (size_t i = 0; i < 4; ++i) {
      scratch_.sides[i] = uint32_t(end - begin);
      *end++ = gridEdges_.corners[cell.corners[outline.corners[i]]];
      const auto inside = gridEdges_.vertices[cell.edges[outline.edges[i]]];
      for (size_t k = 0; k < inside.size(); ++k) {
        betweenCorners_ = {betweenCorners_[1], uint32_t(end - begin)};
        *end++ = inside[i < 2 ? k : inside.size() - 1 - k];
      }
    }
    scratch_.sides[4] = uint32_t(end - begin);
    return {begin, end};
  }

  FaceId beginFace(GridFaceId gridFace) {
    gridFaceOf_.add(gridFace);
    return {uint32_t(triFaces_.size() + gridFaceOf_.size() - 1)};
  }
  void endLoop() { pastLoopVertex_.add(uint32_t(loopVertices_.size())); }
  void endFace(FaceId id) {
    pastLoop_.add(uint32_t(pastLoopVertex_.size() - 1));
    halfFaces_.add(HalfFace(id, 0));
  }
  /// One with one loop, of which addParts(add) calls add(from, count) for the parts, after each of which a block can be read.
  template <class F>
  void addPiece(GridFaceId gridFace, const F& addParts) {
    const FaceId id = beginFace(gridFace);
    addParts([&](const VertexId* from, size_t count) { loopVertices_.addBlocks(from, count); });
    endLoop();
    endFace(id);
  }

  /// Where chain_ parts it.
  void addChained(GridFaceId gridFace, std::span<const VertexId> outline, size_t edges) {
    for (uint32_t piece = 0; piece < 2; ++piece) addPiece(gridFace, [&](const auto& add) { chain_.forLoop(piece, outline, edges, add); });
    beside_.add(scratch_.sides.begin(), scratch_.sides.end());
    beside_.fill(chain_.first, chain_.other);
    beside_.fill(chain_.last - chain_.first, chain_.between);
    beside_.fill(outline.size() - chain_.last, chain_.other);
    for (size_t e = 0; e < edges; ++e) {
      const uint32_t left = chain_.runsToLast[e] ? chain_.other : chain_.between;
      beside_.add(left);
      beside_.add(1 - left);
    }
  }
  /// Where scratch_.chains do.
  void addChained(GridFaceId gridFace, size_t sides) {
    for (size_t piece = 0; piece < scratch_.chains.loops.size(); ++piece) {
      const FaceId id = beginFace(gridFace);
      for (const GraphVertex v : scratch_.chains.loops[piece]) loopVertices_.add(scratch_.graph.vertex(v));
      endLoop();
      endFace(id);
    }
    const std::vector<uint32_t>& found = scratch_.chains.beside;
    beside_.add(scratch_.sides.begin(), scratch_.sides.end());
    for (size_t side = 0; side < sides; ++side) beside_.add(found[2 * side]);
    beside_.add(found.begin() + ptrdiff_t(2 * sides), found.end());
  }

  void cutByGraph(GridFaceId gridFace) {
    PlanarGraph& graph = scratch_.graph;
    const int axis = stencil_.faces[gridFace].axis();
    graph.build(scratch_.predicates);

    auto& seen = scratch_.seen;
    seen.assign(graph.faceCount, std::nullopt);
    for (const FaceId f : stencil_.triFacesOnFace[gridFace]) {
      const bool down = normalSign(*input_.mesh, triFaces_.triangles[f], axis, scratch_.predicates) < 0;
      std::optional<HalfFace>& halfFace = seen[faceOfTriFace(f, down)];
      if (halfFace) vertices_.failSelfIntersection(triangleOf(*halfFace), triFaces_.triangles[f]);
      halfFace = HalfFace(f, down ? 1 : 0);
      halfFaces_.add(*halfFace);
    }
    for (size_t l = 0; l < graph.loopStarts.size();) {
      const PlanarGraph::Face face = graph.loopFaces[l];
      if (seen[face]) {
        if (++l < graph.loopStarts.size() && graph.loopFaces[l] == face &&
            !input_.mesh->arrangement) {  // something lies inside of the triangle
          vertices_.failSelfIntersection(triangleOf(*seen[face]), vertices_.triangleAt(graph.origin(graph.loopStarts[l])));
        }
        continue;
      }
      const FaceId id = beginFace(gridFace);
      for (; l < graph.loopStarts.size() && graph.loopFaces[l] == face; ++l) addLoop(graph.loopStarts[l]);
      seen[face] = HalfFace(id, 0);
      endFace(id);
    }
    addSlits();
  }

  void addLoop(PlanarGraph::HalfEdge start) {
    std::vector<VertexId>& loop = scratch_.loop;
    loop.clear();
    scratch_.graph.appendLoop(start, loop);
    if (loop.size() < 3) vertices_.failSelfIntersectionAt(loop.front(), loop.back());  // two cut-edges on each other
    loopVertices_.add(loop.begin(), loop.end());
    endLoop();
  }

  /// The graph's face that a tri-cut-face in the plane is: its loop must be that face's only boundary.
  PlanarGraph::Face faceOfTriFace(FaceId f, bool down) {
    const PlanarGraph& graph = scratch_.graph;
    std::vector<VertexId>& loop = scratch_.loop;
    const auto outer = triFaces_.loopsOf(f)[0];
    loop.assign(outer.begin(), outer.end());
    if (down) std::reverse(loop.begin(), loop.end());
    if (input_.mesh->arrangement) return faceBeside(f, loop);
    const auto start = graph.find(loop[0], loop[1]);
    if (!start) failAround(f, loop);
    PlanarGraph::HalfEdge h = *start;
    for (size_t i = 0; i < loop.size(); ++i) {
      if (graph.face(h) == PlanarGraph::kOutside || graph.isSlit(h) || graph.origin(h) != loop[i]) failAround(f, loop);
      h = graph.next(h);
    }
    if (h != *start) failAround(f, loop);
    return graph.face(h);
  }

  /// The same where it is known that nothing crosses the loop, which may run forth and back along slits.
  PlanarGraph::Face faceBeside(FaceId f, const std::vector<VertexId>& loop) {
    const PlanarGraph& graph = scratch_.graph;
    for (size_t i = 0; i < loop.size(); ++i) {
      const auto h = graph.find(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
      if (h && !graph.isSlit(*h) && graph.face(*h) != PlanarGraph::kOutside) return graph.face(*h);
    }
    failAround(f, loop);
  }

  /// Something crosses or overlaps a triangle in the plane: names another triangle at one of the vertices in the grid-face.
  [[noreturn]] void failAround(FaceId f, const std::vector<VertexId>& loop) {
    const TriangleId triangle = triFaces_.triangles[f];
    const PlanarGraph& graph = scratch_.graph;
    for (const PlanarGraph::HalfEdge h : graph.inner()) {
      const VertexId v = graph.origin(h);
      if (std::count(loop.begin(), loop.end(), v)) continue;
      const auto other = vertices_.triangleAt(v);
      if (other && other != triangle) vertices_.failSelfIntersection(triangle, other);
    }
    for (const VertexId v : loop) {
      const auto other = vertices_.triangleAt(v);
      if (other && other != triangle) vertices_.failSelfIntersection(triangle, other);
    }
    vertices_.failSelfIntersection(triangle, triangle);
  }

  /// The triangle that a tri-cut-face is a piece of.
  TriangleId triangleOf(HalfFace halfFace) const { return triFaces_.triangles[halfFace.face()]; }

  void addSlits() {
    const PlanarGraph& graph = scratch_.graph;
    for (const PlanarGraph::HalfEdge h : graph.inner()) {
      if (h.number % 2 == 1 || !graph.isSlit(h)) continue;  // each once
      const HalfFace halfFace = *scratch_.seen[graph.face(h)];
      const Slit slit = {graph.origin(h), graph.origin(h.twin()), halfFace};
      const bool inTriangle = halfFace.face().number < triFaces_.size();
      if (inTriangle && input_.mesh->arrangement) continue;  // in the loops of that face
      if (inTriangle) vertices_.failSelfIntersection(triangleOf(halfFace), vertices_.triangleAt(slit.from));
      faces_.slits.items.push_back(slit);
    }
  }

  const Input& input_;
  const Stencil& stencil_;
  const GridEdges& gridEdges_;
  const TriFaces& triFaces_;
  const CutVertices& vertices_;
  GridFaceScratch& scratch_;
  GridFaces& faces_;
  const Most most_;
  Appender<VertexId> loopVertices_;
  Appender<uint32_t> pastLoopVertex_, pastLoop_;
  Appender<GridFaceId> gridFaceOf_;
  Appender<HalfFace> halfFaces_;
  Appender<uint32_t> pastHalfFace_, pastSlit_, beside_, pastBeside_;
  Appender<GridFaceKind> kinds_;
  OneChain chain_;
  std::array<uint32_t, 2> betweenCorners_{};  // the places in the outline of the last two vertices that are not at corners
};

}  // namespace

void cutGridFaces(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, GridFaceScratch& scratch,
                  GridFaces& faces) {
  FaceCutter cutter(surface, stencil, gridEdges, scratch, faces);
  for (const GridFaceId g : stencil.faces.ids()) cutter.cut(g);
}

}  // namespace mandoline::detail
