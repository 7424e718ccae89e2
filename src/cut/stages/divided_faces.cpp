#include "cut/stages/divided_faces.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "cut/stages/planar_graph.h"

namespace mandoline::detail {
namespace {

using Link = std::array<VertexId, 2>;

/// A piece of a tri-edge in the inside of the triangle at hand.
struct Piece {
  Slab element;
  Link ends;
};

struct PlacedVertex {
  Slab slab;
  VertexId vertex;
};

/// What one chunk of triangles makes.
struct DividedChunk {
  TriFaces faces;
  Predicates predicates;
  PlanarGraph graph;
};

/// The faces of one triangle, before it is known which of them are its own.
struct LocalFaces {
  std::vector<Slab> elements;
  Csr<VertexId> loops;
  std::vector<uint32_t> faceLoopOffsets{0};

  size_t size() const { return elements.size(); }
  void clear() {
    elements.clear();
    loops = {};
    faceLoopOffsets.assign(1, 0);
  }
  void endFace(const Slab& element) {
    elements.push_back(element);
    faceLoopOffsets.push_back(uint32_t(loops.size()));
  }
};

class Divider {
 public:
  Divider(const Surface& surface, const UndividedFaces& undivided, DividedChunk& chunk)
      : input_(surface.input),
        arrangement_(*surface.input.mesh->arrangement),
        edges_(surface.edges()),
        vertices_(surface.vertices),
        undivided_(undivided),
        chunk_(chunk) {}

  /// Faces first .. past - 1 and the hybrid edges are all of one triangle.
  void divide(FaceId first, FaceId past, std::span<const FaceEdge> hybridEdges) {
    triangle_ = undivided_.triangles[first];
    for (axis_ = 0; (normal_ = normalSign(*input_.mesh, triangle_, axis_, chunk_.predicates)) == 0;) ++axis_;
    collectInside();
    local_.clear();
    for (const FaceId f : Ids<FaceId>(first, past)) divideFace(f);
    cutHybridEdges(hybridEdges);
    assignParents();
    emit();
  }

 private:
  static Link sorted(VertexId u, VertexId v) { return {std::min(u, v), std::max(u, v)}; }

  /// The vertices and edges inside of the triangle, by the grid element that they lie in.
  void collectInside() {
    placed_.clear();
    pieces_.clear();
    inPlane_.clear();
    const auto t = input_.verticesOf(triangle_);
    ownPlanes_ = 0;  // axial planes that the triangle lies in
    for (size_t d = 0; d < 3; ++d) {
      const int32_t slab = input_.slabs[t[0]][d];
      ownPlanes_ += onPlane(slab) && input_.slabs[t[1]][d] == slab && input_.slabs[t[2]][d] == slab;
    }
    const auto place = [&](VertexId v) {
      if (planeCount(vertices_.slab(v)) > ownPlanes_) placed_.push_back({vertices_.slab(v), v});
    };
    for (const uint32_t v : arrangement_.innerVertices[triangle_.number]) place({v});
    for (const TriEdgeId e : edges_.innerOf(triangle_)) {
      VertexId from = edges_.ends[e][0];
      const auto add = [&](VertexId to) {
        const Slab element = elementBetween(vertices_.slab(from), vertices_.slab(to));
        if (planeCount(element) > ownPlanes_) {
          inPlane_.push_back(sorted(from, to));
        } else {
          pieces_.push_back({element, {from, to}});
        }
        from = to;
      };
      for (const VertexId v : vertices_.crossings(e)) {
        if (!vertices_.isUsed(v)) continue;
        place(v);
        add(v);
      }
      add(edges_.ends[e][1]);
    }
    sortItems(placed_,
              [](const PlacedVertex& a, const PlacedVertex& b) { return a.slab != b.slab ? a.slab < b.slab : a.vertex < b.vertex; });
    sortItems(pieces_, [](const Piece& a, const Piece& b) { return a.element != b.element ? a.element < b.element : a.ends < b.ends; });
    sortItems(inPlane_);
  }

  /// Calls f(vertex) for those of the arrangement that lie between two vertices of a side that an axial plane made, in order.
  template <class F>
  void forBetween(VertexId u, VertexId v, const F& f) {
    const Slab element = elementBetween(vertices_.slab(u), vertices_.slab(v));
    if (planeCount(element) <= ownPlanes_) return;
    const auto [first, past] = std::equal_range(placed_.begin(), placed_.end(), PlacedVertex{element, {0}},
                                                [](const PlacedVertex& a, const PlacedVertex& b) { return a.slab < b.slab; });
    if (first == past) return;
    between_.clear();
    for (auto at = first; at != past; ++at) {
      if (at->vertex != u && at->vertex != v) between_.push_back(at->vertex);
    }
    int axis = 0;
    while (axis < 2 && vertices_.compare(u, v, axis, chunk_.predicates) == 0) ++axis;
    const int way = vertices_.compare(u, v, axis, chunk_.predicates);
    sortItems(between_, [&](VertexId a, VertexId b) { return vertices_.compare(a, b, axis, chunk_.predicates) == way; });
    for (const VertexId w : between_) f(w);
  }

  void divideFace(FaceId face) {
    const Slab& element = undivided_.elements[face];
    const auto loop = undivided_.loopsOf(face)[0];
    outline_.clear();
    for (size_t i = 0; i < loop.size(); ++i) {
      outline_.push_back(loop[i]);
      forBetween(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0], [&](VertexId v) { outline_.push_back(v); });
    }
    const auto [first, past] = std::equal_range(pieces_.begin(), pieces_.end(), Piece{element, {}},
                                                [](const Piece& a, const Piece& b) { return a.element < b.element; });
    if (first == past) {
      local_.loops.items.insert(local_.loops.items.end(), outline_.begin(), outline_.end());
      local_.loops.endGroup();
      return local_.endFace(element);
    }
    PlanarGraph& graph = chunk_.graph;
    graph.begin(vertices_, axis_);
    if (normal_ < 0) std::reverse(outline_.begin(), outline_.end());
    graph.setOutline(outline_);
    for (auto piece = first; piece != past; ++piece) graph.addEdge(piece->ends[0], piece->ends[1]);
    graph.build(chunk_.predicates, PlanarGraph::Slits::in);
    for (size_t l = 0; l < graph.loopStarts.size(); ++l) {
      addLoop(graph.loopStarts[l]);
      if (l + 1 == graph.loopStarts.size() || graph.loopFaces[l + 1] != graph.loopFaces[l]) local_.endFace(element);
    }
  }

  void addLoop(PlanarGraph::HalfEdge start) {
    std::vector<VertexId>& items = local_.loops.items;
    const size_t first = items.size();
    chunk_.graph.appendLoop(start, items);
    if (normal_ < 0) std::reverse(items.begin() + std::ptrdiff_t(first), items.end());
    local_.loops.endGroup();
  }

  void cutHybridEdges(std::span<const FaceEdge> hybridEdges) {
    hybrid_.clear();
    for (const auto& [element, start, end] : hybridEdges) {
      VertexId from = start;
      const auto add = [&, &place = element](VertexId to) {
        if (!std::binary_search(inPlane_.begin(), inPlane_.end(), sorted(from, to))) hybrid_.push_back({place, from, to});
        from = to;
      };
      forBetween(start, end, add);
      add(end);
    }
  }

  /// Finds which triangles each face is a piece of: the same ones across hybrid edges.
  void assignParents() {
    owned_.assign(local_.size(), 1);
    otherParents_.assign(local_.size(), {});
    const auto overlaps = arrangement_.overlaps[triangle_.number];
    if (overlaps.empty()) return;
    struct Use {
      Link link;
      uint32_t face;
      bool forward;  // runs from the lower end to the higher
    };
    std::vector<Use> uses;
    for (uint32_t f = 0; f < local_.size(); ++f) {
      for (const auto loop : local_.loops.groups(local_.faceLoopOffsets[f], local_.faceLoopOffsets[f + 1])) {
        for (size_t i = 0; i < loop.size(); ++i) {
          const VertexId u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
          uses.push_back({sorted(u, v), f, u < v});
        }
      }
    }
    sortItems(uses, [](const Use& a, const Use& b) { return a.link != b.link ? a.link < b.link : a.face < b.face; });
    DisjointSets sets(local_.size());
    std::vector<std::pair<TriEdgeId, bool>> borders(local_.size(),
                                                    {{~0u}, false});  // of each face: a tri-edge, and in which direction the face has it
    for (size_t i = 0; i < uses.size(); ++i) {
      const auto& [link, face, forward] = uses[i];
      if (const auto edge = vertices_.triEdgeOf(link)) {
        borders[face] = {*edge, forward == vertices_.runsUp(*edge, link)};
      } else if (i > 0 && uses[i - 1].link == link) {
        sets.unite(uses[i - 1].face, face);
      }
    }
    std::vector<uint32_t> bordered(local_.size(), ~0u);  // per root: a face with a border
    for (uint32_t f = 0; f < local_.size(); ++f) {
      if (borders[f].first.number != ~0u) bordered[sets.find(f)] = f;
    }
    for (uint32_t f = 0; f < local_.size(); ++f) {
      const uint32_t at = bordered[sets.find(f)];
      if (at == ~0u) vertices_.failSelfIntersection(triangle_, TriangleId{overlaps[0]});
      const auto [edge, forward] = borders[at];
      for (const uint32_t other : overlaps) {
        if (!covers({other}, edge, forward)) continue;
        if (other < triangle_.number) owned_[f] = 0;
        otherParents_[f].push_back({other});
      }
    }
    std::erase_if(hybrid_, [&](const FaceEdge& e) {
      const Link link = sorted(e.from, e.to);
      const auto use = std::lower_bound(uses.begin(), uses.end(), link, [](const Use& u, const Link& l) { return u.link < l; });
      return use == uses.end() || use->link != link || !owned_[use->face] || !input_.inGrid(e.element);
    });
  }

  /// Whether a triangle in the plane covers the area left of a tri-edge of this one, which is traversed forward or not.
  bool covers(TriangleId other, TriEdgeId edge, bool forward) {
    const auto inner = edges_.innerOf(other);
    if (std::find(inner.begin(), inner.end(), edge) != inner.end()) return true;
    bool covered = false;
    const bool same = isSameWay(other);
    for (int side = 0; side < 3; ++side) {
      edges_.forSide(*input_.mesh, other, side,
                     [&](TriEdgeId e, bool otherForward) { covered |= e == edge && (otherForward == forward) == same; });
    }
    return covered;
  }
  bool isSameWay(TriangleId other) { return normalSign(*input_.mesh, other, axis_, chunk_.predicates) == normal_; }

  void emit() {
    TriFaces& faces = chunk_.faces;
    for (uint32_t f = 0; f < local_.size(); ++f) {
      if (!owned_[f] || !input_.inGrid(local_.elements[f])) continue;
      bool touchesLine = false;
      for (const auto loop : local_.loops.groups(local_.faceLoopOffsets[f], local_.faceLoopOffsets[f + 1])) {
        for (const VertexId v : loop) touchesLine |= planeCount(vertices_.slab(v)) > 1;
        faces.loops.items.insert(faces.loops.items.end(), loop.begin(), loop.end());
        faces.loops.endGroup();
      }
      faces.faceLoopOffsets.push_back(uint32_t(faces.loops.size()));
      for (const TriangleId other : otherParents_[f]) faces.otherParents.push_back({{uint32_t(faces.size())}, other, isSameWay(other)});
      faces.triangles.push_back(triangle_);
      faces.elements.push_back(local_.elements[f]);
      faces.touchesLine.push_back(touchesLine);
    }
    faces.hybridEdges.insert(faces.hybridEdges.end(), hybrid_.begin(), hybrid_.end());
  }

  const Input& input_;
  const Arrangement& arrangement_;
  const MeshEdges& edges_;
  const CutVertices& vertices_;
  const UndividedFaces& undivided_;
  DividedChunk& chunk_;
  TriangleId triangle_{0};
  int axis_ = 0, normal_ = 0;  // an axis that the triangle's plane is not parallel to, and the sign of its normal along it
  int ownPlanes_ = 0;
  std::vector<PlacedVertex> placed_;
  std::vector<Piece> pieces_;
  std::vector<Link> inPlane_;  // pieces of inner tri-edges in an axial plane
  std::vector<VertexId> between_, outline_;
  LocalFaces local_;
  std::vector<FaceEdge> hybrid_;
  std::vector<uint8_t> owned_;                         // per local face
  std::vector<std::vector<TriangleId>> otherParents_;  // per local face
};

void append(TriFaces& faces, const TriFaces& more) {
  const uint32_t shift = uint32_t(faces.size());
  appendOffsets(faces.faceLoopOffsets, more.faceLoopOffsets);
  faces.loops.append(more.loops);
  faces.triangles.insert(faces.triangles.end(), more.triangles.begin(), more.triangles.end());
  faces.elements.insert(faces.elements.end(), more.elements.begin(), more.elements.end());
  faces.touchesLine.insert(faces.touchesLine.end(), more.touchesLine.begin(), more.touchesLine.end());
  faces.hybridEdges.insert(faces.hybridEdges.end(), more.hybridEdges.begin(), more.hybridEdges.end());
  for (const auto& [face, triangle, sameWay] : more.otherParents) faces.otherParents.push_back({{face.number + shift}, triangle, sameWay});
}

}  // namespace

void divideFaces(const Surface& surface, const UndividedFaces& undivided, TriFaces& faces, Run& run) {
  if (undivided.size() == 0) return;
  struct Group {
    FaceId firstFace, pastFace;
    size_t firstEdge, pastEdge;  // hybrid edges
  };
  std::vector<Group> groups;
  for (const FaceId f : undivided.ids()) {
    if (f.number == 0 || undivided.triangles[f] != undivided.triangles[{f.number - 1}]) groups.push_back({f, f, 0, 0});
    groups.back().pastFace = {f.number + 1};
  }
  size_t at = 0;
  for (Group& group : groups) {
    group.firstEdge = at;
    while (at < undivided.hybridEdges.size() && undivided.hybridTriangles[at] == undivided.triangles[group.firstFace]) ++at;
    group.pastEdge = at;
  }
  auto chunks = forChunks<DividedChunk>(
      groups.size(), run.monitor,
      [&](DividedChunk& chunk, size_t begin, size_t end) {
        Divider divider(surface, undivided, chunk);
        if (begin < end && chunk.faces.faceLoopOffsets.empty()) chunk.faces.faceLoopOffsets.assign(1, 0);
        for (size_t g = begin; g < end; ++g) {
          const auto& [firstFace, pastFace, firstEdge, pastEdge] = groups[g];
          divider.divide(firstFace, pastFace, {undivided.hybridEdges.data() + firstEdge, pastEdge - firstEdge});
        }
      },
      64);
  for (uint32_t f = 0; f <= faces.size(); ++f) faces.faceLoopOffsets.push_back(f);
  for (const DividedChunk& chunk : chunks) {
    if (!chunk.faces.faceLoopOffsets.empty()) append(faces, chunk.faces);
    run.count(chunk.predicates);
  }
}

}  // namespace mandoline::detail
