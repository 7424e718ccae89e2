#include "cut/stages/grid_faces.h"

#include <optional>

#include "cut/stages/planar_graph.h"

namespace mandoline::detail {
namespace {

struct Chunk {
  GridFaces faces;  // ids count from triFaces.size() on
  Predicates predicates;
  PlanarGraph graph;
  std::vector<uint32_t> outline, loop;
  std::vector<std::optional<HalfFace>> seen;  // per face of the graph: what the cell below the plane sees
};

class FaceCutter {
 public:
  FaceCutter(const Surface& surface, const Stencil& stencil, const GridEdges& gridEdges, const TriFaces& triFaces, Chunk& chunk)
      : input_(surface.input), stencil_(stencil), gridEdges_(gridEdges), triFaces_(triFaces), vertices_(surface.vertices), chunk_(chunk) {}

  void cut(uint32_t gridFace) {
    findOutline(stencil_.faces[gridFace]);
    if (stencil_.edgesOnFace[gridFace].empty() && stencil_.triFacesOnFace[gridFace].empty()) {
      addWhole(gridFace);
    } else {
      cutByGraph(gridFace);
    }
    GridFaces& faces = chunk_.faces;
    faces.halfFaces.offsets.push_back(uint32_t(faces.halfFaces.items.size()));
    faces.slits.offsets.push_back(uint32_t(faces.slits.items.size()));
  }

 private:
  /// The vertices on the sides, counter-clockwise about the axis.
  void findOutline(const Stencil::Face& face) {
    const auto corners = stencil_.cornersOf(face), edges = stencil_.edgesOf(face);
    std::vector<uint32_t>& outline = chunk_.outline;
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

  FaceId beginFace(uint32_t gridFace) {
    chunk_.faces.gridFaces.push_back(gridFace);
    return {uint32_t(triFaces_.size() + chunk_.faces.size() - 1)};
  }
  void endLoop() { chunk_.faces.loopOffsets.push_back(uint32_t(chunk_.faces.loopVertices.size())); }
  void endFace(FaceId id) {
    chunk_.faces.faceLoopOffsets.push_back(uint32_t(chunk_.faces.loopOffsets.size() - 1));
    chunk_.faces.halfFaces.items.push_back(HalfFace(id, 0));
  }

  void addWhole(uint32_t gridFace) {
    const FaceId id = beginFace(gridFace);
    chunk_.faces.loopVertices.insert(chunk_.faces.loopVertices.end(), chunk_.outline.begin(), chunk_.outline.end());
    endLoop();
    endFace(id);
  }

  void cutByGraph(uint32_t gridFace) {
    PlanarGraph& graph = chunk_.graph;
    const int axis = stencil_.faces[gridFace].axis();
    graph.begin(vertices_, axis);
    graph.setOutline(chunk_.outline);
    for (const FaceEdge& e : stencil_.edgesOnFace[gridFace]) graph.addEdge(e.from, e.to);
    graph.build(chunk_.predicates);

    auto& seen = chunk_.seen;
    seen.assign(graph.faceCount, std::nullopt);
    for (const uint32_t f : stencil_.triFacesOnFace[gridFace]) {
      const bool down = normalSign(triFaces_.triangles[f], axis) < 0;
      std::optional<HalfFace>& halfFace = seen[faceOfTriFace(f, down)];
      if (halfFace) vertices_.failSelfIntersection(triangleOf(*halfFace), triFaces_.triangles[f]);
      halfFace = HalfFace(FaceId{f}, down ? 1 : 0);
      chunk_.faces.halfFaces.items.push_back(*halfFace);
    }
    for (size_t l = 0; l < graph.loopStarts.size();) {
      const uint32_t face = graph.loopFaces[l];
      if (seen[face]) {
        if (++l < graph.loopStarts.size() && graph.loopFaces[l] == face) {  // something lies inside of the triangle
          vertices_.failSelfIntersection(triangleOf(*seen[face]), vertices_.triangleAt(graph.vertexId(graph.origin(graph.loopStarts[l]))));
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

  void addLoop(uint32_t start) {
    const PlanarGraph& graph = chunk_.graph;
    std::vector<uint32_t>& loop = chunk_.faces.loopVertices;
    const size_t first = loop.size();
    uint32_t h = start;
    do {
      loop.push_back(graph.vertexId(graph.origin(h)));
      h = graph.next(h);
    } while (h != start);
    if (loop.size() - first < 3) vertices_.failSelfIntersectionAt(loop[first], loop.back());  // two cut-edges on top of each other
    endLoop();
  }

  /// The graph's face that a tri-cut-face in the plane is: its loop must be that face's only boundary.
  uint32_t faceOfTriFace(uint32_t f, bool down) {
    const PlanarGraph& graph = chunk_.graph;
    std::vector<uint32_t>& loop = chunk_.loop;
    loop.assign(triFaces_.loop(f).begin(), triFaces_.loop(f).end());
    if (down) std::reverse(loop.begin(), loop.end());
    const uint32_t start = graph.find(loop[0], loop[1]);
    uint32_t h = start;
    for (size_t i = 0; i < loop.size(); ++i) {
      if (h == PlanarGraph::kOutside || graph.face(h) == PlanarGraph::kOutside || graph.isSlit(h) ||
          graph.vertexId(graph.origin(h)) != loop[i]) {
        failAround(f, loop);
      }
      h = graph.next(h);
    }
    if (h != start) failAround(f, loop);
    return graph.face(start);
  }

  /// Something crosses or overlaps a triangle in the plane: names another triangle at one of the vertices in the grid-face.
  [[noreturn]] void failAround(uint32_t f, const std::vector<uint32_t>& loop) {
    const uint32_t triangle = triFaces_.triangles[f];
    const PlanarGraph& graph = chunk_.graph;
    for (uint32_t h = uint32_t(2 * graph.outlineSize()); h < 2 * graph.edgeCount(); ++h) {
      const uint32_t v = graph.vertexId(graph.origin(h));
      if (std::count(loop.begin(), loop.end(), v)) continue;
      const int64_t other = vertices_.triangleAt(v);
      if (other >= 0 && other != triangle) vertices_.failSelfIntersection(triangle, other);
    }
    for (const uint32_t v : loop) {
      const int64_t other = vertices_.triangleAt(v);
      if (other >= 0 && other != triangle) vertices_.failSelfIntersection(triangle, other);
    }
    vertices_.failSelfIntersection(triangle, triangle);
  }

  /// The triangle that a tri-cut-face is a piece of.
  uint32_t triangleOf(HalfFace halfFace) const { return triFaces_.triangles[halfFace.face().number]; }

  void addSlits() {
    const PlanarGraph& graph = chunk_.graph;
    for (uint32_t h = uint32_t(2 * graph.outlineSize()); h < 2 * graph.edgeCount(); h += 2) {
      if (!graph.isSlit(h)) continue;
      const HalfFace halfFace = *chunk_.seen[graph.face(h)];
      const Slit slit = {graph.vertexId(graph.origin(h)), graph.vertexId(graph.origin(h ^ 1)), halfFace};
      if (halfFace.face().number < triFaces_.size()) vertices_.failSelfIntersection(triangleOf(halfFace), vertices_.triangleAt(slit.from));
      chunk_.faces.slits.items.push_back(slit);
    }
  }

  int normalSign(uint32_t triangle, int axis) {
    const auto& t = input_.triangles[triangle];
    const Point &a = input_.points[t[0]], &b = input_.points[t[1]], &c = input_.points[t[2]];
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    return chunk_.predicates.orient2d({a[p], a[q]}, {b[p], b[q]}, {c[p], c[q]});
  }

  const Input& input_;
  const Stencil& stencil_;
  const GridEdges& gridEdges_;
  const TriFaces& triFaces_;
  const CutVertices& vertices_;
  Chunk& chunk_;
};

void appendOffsets(std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  const uint32_t shift = a.back();
  for (size_t i = 1; i < b.size(); ++i) a.push_back(b[i] + shift);
}

/// Appends b, whose own faces come after those of the chunks before it.
void append(GridFaces& a, const GridFaces& b, uint32_t firstOwn) {
  const uint32_t shift = uint32_t(a.size());
  const auto shifted = [&](HalfFace h) { return h.face().number < firstOwn ? h : HalfFace({h.face().number + shift}, h.side()); };
  appendOffsets(a.faceLoopOffsets, b.faceLoopOffsets);
  appendOffsets(a.loopOffsets, b.loopOffsets);
  a.loopVertices.insert(a.loopVertices.end(), b.loopVertices.begin(), b.loopVertices.end());
  a.gridFaces.insert(a.gridFaces.end(), b.gridFaces.begin(), b.gridFaces.end());
  appendOffsets(a.halfFaces.offsets, b.halfFaces.offsets);
  for (const HalfFace h : b.halfFaces.items) a.halfFaces.items.push_back(shifted(h));
  appendOffsets(a.slits.offsets, b.slits.offsets);
  for (const Slit& s : b.slits.items) a.slits.items.push_back({s.from, s.to, shifted(s.halfFace)});
}

}  // namespace

GridFaces cutGridFaces(const Surface& surface, const Stencil& stencil, const GridEdges& gridEdges, const TriFaces& triFaces, Run& run) {
  auto chunks = forChunks<Chunk>(stencil.faces.size(), run.monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    FaceCutter cutter(surface, stencil, gridEdges, triFaces, chunk);
    for (size_t g = begin; g < end; ++g) cutter.cut(uint32_t(g));
  });
  GridFaces faces = std::move(chunks[0].faces);
  for (size_t c = 0; c < chunks.size(); ++c) {
    if (c > 0) append(faces, chunks[c].faces, uint32_t(triFaces.size()));
    run.count(chunks[c].predicates);
  }
  return faces;
}

}  // namespace mandoline::detail
