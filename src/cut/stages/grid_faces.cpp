#include "cut/stages/grid_faces.h"

#include <optional>

#include "cut/stages/planar_graph.h"

namespace mandoline::detail {
namespace {

struct Chunk {
  GridFaces faces;  // ids count from triFaces.size() on
  Predicates predicates;
  PlanarGraph graph;
  Chains chains;
  std::vector<VertexId> outline, loop;
  IdVector<PlanarGraph::Face, std::optional<HalfFace>> seen;  // per face of the graph: what the cell below the plane sees
};

class FaceCutter {
 public:
  FaceCutter(const Surface& surface, const Stencil& stencil, const GridEdges& gridEdges, const TriFaces& triFaces, Chunk& chunk)
      : input_(surface.input), stencil_(stencil), gridEdges_(gridEdges), triFaces_(triFaces), vertices_(surface.vertices), chunk_(chunk) {}

  /// Without chains.h.
  bool onlyGraph = false;

  void cut(GridFaceId gridFace) {
    findOutline(stencil_.faces[gridFace]);
    if (stencil_.edgesOnFace[gridFace].empty() && stencil_.triFacesOnFace[gridFace].empty()) {
      addWhole(gridFace);
    } else {
      cutByGraph(gridFace);
    }
    chunk_.faces.halfFaces.endGroup();
    chunk_.faces.slits.endGroup();
  }

 private:
  /// The vertices on the sides, counter-clockwise about the axis.
  void findOutline(const Stencil::Face& face) {
    const auto corners = stencil_.cornersOf(face);
    const auto edges = stencil_.edgesOf(face);
    std::vector<VertexId>& outline = chunk_.outline;
    outline.clear();
    for (int i = 0; i < 4; ++i) {
      outline.push_back(gridEdges_.corners[corners[i]]);
      const auto inside = gridEdges_.vertices[edges[i]];
      if (i < 2) {
        outline.insert(outline.end(), inside.begin(), inside.end());
      } else {
        outline.insert(outline.end(), inside.rbegin(), inside.rend());
      }
    }
  }

  FaceId beginFace(GridFaceId gridFace) {
    chunk_.faces.gridFaces.push_back(gridFace);
    return {uint32_t(triFaces_.size() + chunk_.faces.size() - 1)};
  }
  void endFace(FaceId id) {
    chunk_.faces.faceLoopOffsets.push_back(uint32_t(chunk_.faces.loops.size()));
    chunk_.faces.halfFaces.items.push_back(HalfFace(id, 0));
  }

  void addWhole(GridFaceId gridFace) {
    const FaceId id = beginFace(gridFace);
    Csr<VertexId>& loops = chunk_.faces.loops;
    loops.items.insert(loops.items.end(), chunk_.outline.begin(), chunk_.outline.end());
    loops.endGroup();
    endFace(id);
  }

  void cutByGraph(GridFaceId gridFace) {
    PlanarGraph& graph = chunk_.graph;
    const int axis = stencil_.faces[gridFace].axis();
    graph.begin(vertices_, axis);
    graph.setOutline(chunk_.outline);
    for (const FaceEdge& e : stencil_.edgesOnFace[gridFace]) graph.addEdge(e.from, e.to);
    if (!onlyGraph && stencil_.triFacesOnFace[gridFace].empty() && graph.traceChains(chunk_.chains)) return addChained(gridFace);
    graph.build(chunk_.predicates);

    auto& seen = chunk_.seen;
    seen.assign(graph.faceCount, std::nullopt);
    for (const FaceId f : stencil_.triFacesOnFace[gridFace]) {
      const bool down = normalSign(*input_.mesh, triFaces_.triangles[f], axis, chunk_.predicates) < 0;
      std::optional<HalfFace>& halfFace = seen[faceOfTriFace(f, down)];
      if (halfFace) vertices_.failSelfIntersection(triangleOf(*halfFace), triFaces_.triangles[f]);
      halfFace = HalfFace(f, down ? 1 : 0);
      chunk_.faces.halfFaces.items.push_back(*halfFace);
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
    Csr<VertexId>& loops = chunk_.faces.loops;
    for (size_t face = 0; face < chunk_.chains.loops.size(); ++face) {
      const FaceId id = beginFace(gridFace);
      for (const GraphVertex v : chunk_.chains.loops[face]) loops.items.push_back(chunk_.graph.vertex(v));
      loops.endGroup();
      endFace(id);
    }
  }

  void addLoop(PlanarGraph::HalfEdge start) {
    std::vector<VertexId>& vertices = chunk_.faces.loops.items;
    const size_t first = vertices.size();
    chunk_.graph.appendLoop(start, vertices);
    if (vertices.size() - first < 3) vertices_.failSelfIntersectionAt(vertices[first], vertices.back());  // two cut-edges on each other
    chunk_.faces.loops.endGroup();
  }

  /// The graph's face that a tri-cut-face in the plane is: its loop must be that face's only boundary.
  PlanarGraph::Face faceOfTriFace(FaceId f, bool down) {
    const PlanarGraph& graph = chunk_.graph;
    std::vector<VertexId>& loop = chunk_.loop;
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
    const PlanarGraph& graph = chunk_.graph;
    for (size_t i = 0; i < loop.size(); ++i) {
      const auto h = graph.find(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
      if (h && !graph.isSlit(*h) && graph.face(*h) != PlanarGraph::kOutside) return graph.face(*h);
    }
    failAround(f, loop);
  }

  /// Something crosses or overlaps a triangle in the plane: names another triangle at one of the vertices in the grid-face.
  [[noreturn]] void failAround(FaceId f, const std::vector<VertexId>& loop) {
    const TriangleId triangle = triFaces_.triangles[f];
    const PlanarGraph& graph = chunk_.graph;
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
    const PlanarGraph& graph = chunk_.graph;
    for (const PlanarGraph::HalfEdge h : graph.inner()) {
      if (h.number % 2 == 1 || !graph.isSlit(h)) continue;  // each once
      const HalfFace halfFace = *chunk_.seen[graph.face(h)];
      const Slit slit = {graph.origin(h), graph.origin(h.twin()), halfFace};
      const bool inTriangle = halfFace.face().number < triFaces_.size();
      if (inTriangle && input_.mesh->arrangement) continue;  // in the loops of that face
      if (inTriangle) vertices_.failSelfIntersection(triangleOf(halfFace), vertices_.triangleAt(slit.from));
      chunk_.faces.slits.items.push_back(slit);
    }
  }

  const Input& input_;
  const Stencil& stencil_;
  const GridEdges& gridEdges_;
  const TriFaces& triFaces_;
  const CutVertices& vertices_;
  Chunk& chunk_;
};

/// Appends b, whose own faces come after those of the chunks before it.
void append(GridFaces& a, const GridFaces& b, uint32_t firstOwn) {
  const uint32_t shift = uint32_t(a.size());
  const auto shifted = [&](HalfFace h) { return h.face().number < firstOwn ? h : HalfFace({h.face().number + shift}, h.side()); };
  appendOffsets(a.faceLoopOffsets, b.faceLoopOffsets);
  a.loops.append(b.loops);
  a.gridFaces.insert(a.gridFaces.end(), b.gridFaces.begin(), b.gridFaces.end());
  a.halfFaces.append(b.halfFaces, shifted);
  a.slits.append(b.slits, [&](const Slit& s) { return Slit{s.from, s.to, shifted(s.halfFace)}; });
}

}  // namespace

GridFaces cutGridFaces(const Surface& surface, const Stencil& stencil, const GridEdges& gridEdges, const TriFaces& triFaces, Run& run) {
  auto chunks = forChunks<Chunk>(stencil.faces.size(), run.monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    FaceCutter cutter(surface, stencil, gridEdges, triFaces, chunk);
    cutter.onlyGraph = run.onlyGeneral;
    for (const GridFaceId g : Ids<GridFaceId>(begin, end)) cutter.cut(g);
  });
  GridFaces faces = std::move(chunks[0].faces);
  for (size_t c = 0; c < chunks.size(); ++c) {
    if (c > 0) append(faces, chunks[c].faces, uint32_t(triFaces.size()));
    run.count(chunks[c].predicates);
  }
  return faces;
}

}  // namespace mandoline::detail
