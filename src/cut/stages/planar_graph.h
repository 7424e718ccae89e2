// The cut-edges of one grid-face as a planar graph, and its faces (paper, 3.4, 4.3, 4.5 and 4.6).
//
// Half-edges 2 e and 2 e + 1 belong to edge e. The square's outline comes first: the local vertices 0 .. sides - 1 counter-clockwise, and
// edge i from vertex i to the next. Every decision is an exact orientation or comparison of cut-vertices; where one
// comes out as a tie that planar input can't have, the build fails with selfIntersection.
#pragma once

#include <optional>
#include <vector>

#include "base/csr.h"
#include "base/disjoint_sets.h"
#include "cut/predicates/cut_vertices.h"
#include "cut/stages/chains.h"

namespace mandoline::detail {

class PlanarGraph {
 public:
  struct HalfEdge {
    uint32_t number;

    HalfEdge twin() const { return {number ^ 1}; }
    bool operator==(const HalfEdge&) const = default;
  };
  using Face = Id<struct GraphFaceTag>;
  static constexpr Face kOutside{~0u};

  /// Empties the graph for a grid-face across `axis`.
  void begin(const CutVertices& vertices, int axis);
  /// The outline; call before addEdge.
  void setOutline(std::span<const VertexId> outline);
  /// A cut-edge inside of the square.
  void addEdge(VertexId from, VertexId to);

  /// The faces by chains alone, where that is enough: then `chains.loops` holds all of them, and nothing needs to be built.
  bool traceChains(Chains& chains) const { return chains.trace(uint32_t(sides_), ends_, ids_.size()); }
  VertexId vertex(GraphVertex v) const { return ids_[v]; }

  /// Traces the faces: afterwards the members below hold. Slits are left out of the loops, or run through forth and back.
  enum class Slits : bool { out, in };
  void build(Predicates& predicates, Slits slits = Slits::out);

  VertexId origin(HalfEdge h) const { return ids_[ends_[h]]; }
  Face face(HalfEdge h) const { return faceOf_[cycleOf_[h]]; }  ///< to the left, or kOutside
  bool isSlit(HalfEdge h) const { return cycleOf_[h] == cycleOf_[h.twin()]; }
  /// The half-edges of the cut-edges inside of the square.
  Ids<HalfEdge> inner() const { return {2 * sides_, ends_.size()}; }

  uint32_t faceCount = 0;
  std::vector<HalfEdge> loopStarts;  ///< a half-edge of each loop, by face; the outer loop of a face comes first
  std::vector<Face> loopFaces;       ///< the face of each loop, ascending

  /// The half-edge after h in its loop: the next one clockwise about its head that is in the loops.
  HalfEdge next(HalfEdge h) const {
    HalfEdge n = nextOf_[h];
    while (slits_ == Slits::out && isSlit(n)) n = nextOf_[n.twin()];
    return n;
  }
  /// Appends the origins of a loop, from a half-edge of it on.
  void appendLoop(HalfEdge start, std::vector<VertexId>& vertices) const {
    HalfEdge h = start;
    do {
      vertices.push_back(origin(h));
      h = next(h);
    } while (h != start);
  }
  /// The half-edge from one vertex to another, if there is one.
  std::optional<HalfEdge> find(VertexId from, VertexId to) const;

 private:
  using Cycle = Id<struct GraphCycleTag>;  ///< of half-edges, each with the next: an outline of a face with its slits
  static constexpr Cycle kNoCycle{~0u};
  static constexpr Face kUnset{~0u - 1};

  /// A component that does not reach the outline.
  struct Floating {
    std::vector<GraphVertex> members;
    Cycle exterior = kNoCycle;   // the one that runs around it from outside
    std::vector<Cycle> holders;  // those that run around it
  };

  GraphVertex localOf(VertexId id);
  void orderOutgoing(GraphVertex v, Predicates& predicates);
  void sortAround(GraphVertex v, std::span<HalfEdge> out, bool fullCircle, Predicates& predicates);
  void traceCycles();
  void placeComponents(Predicates& predicates);
  void findFloating(Predicates& predicates);
  void findHolders(Predicates& predicates);
  Cycle exteriorCycle(const std::vector<GraphVertex>& component, Predicates& predicates);
  void traceLoops(Predicates& predicates);
  bool isBefore(VertexId u, VertexId v, Predicates& predicates) const;

  const CutVertices* vertices_ = nullptr;
  int axis_ = 0;
  Slits slits_ = Slits::out;
  size_t sides_ = 0;
  IdVector<GraphVertex, VertexId> ids_;
  IdVector<VertexId, GraphVertex> localTable_;  // sparse: valid where ids_ agrees
  IdVector<HalfEdge, GraphVertex> ends_;        // origins
  Csr<HalfEdge, GraphVertex> out_;              // outgoing half-edges, counter-clockwise
  std::vector<uint32_t> at_;                    // scratch
  IdVector<HalfEdge, HalfEdge> nextOf_;         // slits included
  IdVector<HalfEdge, Cycle> cycleOf_;
  IdVector<Cycle, HalfEdge> cycleStarts_;
  IdVector<Cycle, Face> faceOf_;
  IdVector<HalfEdge, uint8_t> traced_;
  IdSets<GraphVertex> components_;
  std::vector<Floating> floating_;
  IdVector<Cycle, uint8_t> isExterior_;
  IdVector<GraphVertex, uint32_t> componentOf_;  // index into floating_, or its size; only where some float
};

}  // namespace mandoline::detail
