#include "cut/stages/grid_faces.h"

namespace mandoline::detail {
namespace {

class FaceCutter {
 public:
  FaceCutter(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, GridFaceScratch& scratch, GridFaces& faces)
      : input_(surface.input),
        stencil_(stencil),
        gridEdges_(gridEdges),
        triFaces_(surface.triFaces),
        vertices_(surface.vertices),
        scratch_(scratch),
        faces_(faces) {}

  void cut(GridFaceId gridFace) {
    findOutline(stencil_.faces[gridFace]);
    if (stencil_.edgesOnFace[gridFace].empty() && stencil_.triFacesOnFace[gridFace].empty()) {
      addWhole(gridFace);
    } else {
      cutByGraph(gridFace);
    }
    faces_.halfFaces.endGroup();
    faces_.slits.endGroup();
    faces_.beside.endGroup();
  }

 private:
  /// The vertices on the sides, counter-clockwise about the axis.
  void findOutline(const Stencil::Face& face) {
    const auto corners = stencil_.cornersOf(face);
    const auto edges = stencil_.edgesOf(face);
    std::vector<VertexId>& outline = scratch_.outline;
    outline.clear();
    for (int i = 0; i < 4; ++i) {
      scratch_.sides[size_t(i)] = uint32_t(outline.size());
      outline.push_back(gridEdges_.corners[corners[i]]);
      const auto inside = gridEdges_.vertices[edges[i]];
      if (i < 2) {
        outline.insert(outline.end(), inside.begin(), inside.end());
      } else {
        outline.insert(outline.end(), inside.rbegin(), inside.rend());
      }
    }
    scratch_.sides[4] = uint32_t(outline.size());
  }

  FaceId beginFace(GridFaceId gridFace) {
    faces_.gridFaces.push_back(gridFace);
    return {uint32_t(triFaces_.size() + faces_.size() - 1)};
  }
  void endFace(FaceId id) {
    faces_.faceLoopOffsets.push_back(uint32_t(faces_.loops.size()));
    faces_.halfFaces.items.push_back(HalfFace(id, 0));
  }

  void addWhole(GridFaceId gridFace) {
    faces_.kinds.push_back(GridFaceKind::whole);
    const FaceId id = beginFace(gridFace);
    Csr<VertexId>& loops = faces_.loops;
    loops.items.insert(loops.items.end(), scratch_.outline.begin(), scratch_.outline.end());
    loops.endGroup();
    endFace(id);
  }

  void cutByGraph(GridFaceId gridFace) {
    PlanarGraph& graph = scratch_.graph;
    const int axis = stencil_.faces[gridFace].axis();
    graph.begin(vertices_, axis);
    graph.setOutline(scratch_.outline);
    for (const FaceEdge& e : stencil_.edgesOnFace[gridFace]) graph.addEdge(e.from, e.to);
    if (!scratch_.onlyGraph && stencil_.triFacesOnFace[gridFace].empty() && graph.traceChains(scratch_.chains)) return addChained(gridFace);
    faces_.kinds.push_back(GridFaceKind::graph);
    graph.build(scratch_.predicates);

    auto& seen = scratch_.seen;
    seen.assign(graph.faceCount, std::nullopt);
    for (const FaceId f : stencil_.triFacesOnFace[gridFace]) {
      const bool down = normalSign(*input_.mesh, triFaces_.triangles[f], axis, scratch_.predicates) < 0;
      std::optional<HalfFace>& halfFace = seen[faceOfTriFace(f, down)];
      if (halfFace) vertices_.failSelfIntersection(triangleOf(*halfFace), triFaces_.triangles[f]);
      halfFace = HalfFace(f, down ? 1 : 0);
      faces_.halfFaces.items.push_back(*halfFace);
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

  void addChained(GridFaceId gridFace) {
    Csr<VertexId>& loops = faces_.loops;
    for (size_t face = 0; face < scratch_.chains.loops.size(); ++face) {
      const FaceId id = beginFace(gridFace);
      for (const GraphVertex v : scratch_.chains.loops[face]) loops.items.push_back(scratch_.graph.vertex(v));
      loops.endGroup();
      endFace(id);
    }
    faces_.kinds.push_back(GridFaceKind::chains);
    std::vector<uint32_t>& beside = faces_.beside.items;
    const std::vector<uint32_t>& found = scratch_.chains.beside;
    const size_t sides = scratch_.outline.size();
    beside.insert(beside.end(), scratch_.sides.begin(), scratch_.sides.end());
    for (size_t side = 0; side < sides; ++side) beside.push_back(found[2 * side]);
    beside.insert(beside.end(), found.begin() + ptrdiff_t(2 * sides), found.end());
  }

  void addLoop(PlanarGraph::HalfEdge start) {
    std::vector<VertexId>& vertices = faces_.loops.items;
    const size_t first = vertices.size();
    scratch_.graph.appendLoop(start, vertices);
    if (vertices.size() - first < 3) vertices_.failSelfIntersectionAt(vertices[first], vertices.back());  // two cut-edges on each other
    faces_.loops.endGroup();
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
};

}  // namespace

void GridFaces::clear() {
  loops.clear();
  faceLoopOffsets.assign(1, 0);
  gridFaces.clear();
  halfFaces.clear();
  slits.clear();
  kinds.clear();
  beside.clear();
}

void cutGridFaces(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, GridFaceScratch& scratch,
                  GridFaces& faces) {
  faces.clear();
  FaceCutter cutter(surface, stencil, gridEdges, scratch, faces);
  for (const GridFaceId g : stencil.faces.ids()) cutter.cut(g);
}

}  // namespace mandoline::detail
