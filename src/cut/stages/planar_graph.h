// The cut-edges of one grid-face as a planar graph, and its faces (paper, 3.4, 4.3, 4.5 and 4.6).
//
// Half-edge h belongs to edge h >> 1; h ^ 1 is its twin. The square's outline comes first: vertices 0 .. sides - 1 counter-clockwise,
// and edge i from vertex i to the next. Every decision is an exact orientation or comparison of cut-vertices; where one comes out as a
// tie that planar input can't have, the build fails with selfIntersection.
#pragma once

#include <vector>

#include "base/disjoint_sets.h"
#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

class PlanarGraph {
 public:
  static constexpr uint32_t kOutside = ~0u;

  /// Empties the graph for a grid-face across `axis`.
  void begin(const CutVertices& vertices, int axis);
  /// The outline; call before addEdge.
  void setOutline(const std::vector<uint32_t>& vertexIds);
  /// A cut-edge inside of the square.
  void addEdge(uint32_t from, uint32_t to);

  /// Traces the faces: afterwards the members below hold.
  void build(Predicates& predicates);

  uint32_t vertexId(uint32_t local) const { return ids_[local]; }
  uint32_t origin(uint32_t h) const { return ends_[h]; }
  uint32_t face(uint32_t h) const { return faceOf_[cycleOf_[h]]; }  ///< face to the left, or kOutside
  bool isSlit(uint32_t h) const { return cycleOf_[h] == cycleOf_[h ^ 1]; }
  size_t edgeCount() const { return ends_.size() / 2; }
  size_t outlineSize() const { return sides_; }

  uint32_t faceCount = 0;
  std::vector<uint32_t> loopStarts;  ///< a half-edge of each loop, by face; the outer loop of a face comes first
  std::vector<uint32_t> loopFaces;   ///< the face of each loop, ascending

  /// The half-edge after h in its loop: the next one clockwise about its head that is no slit.
  uint32_t next(uint32_t h) const {
    uint32_t n = nextOf_[h];
    while (isSlit(n)) n = nextOf_[n ^ 1];
    return n;
  }
  /// The half-edge between two vertices, or kOutside.
  uint32_t find(uint32_t fromId, uint32_t toId) const;

 private:
  static constexpr uint32_t kUnset = ~0u - 1;

  /// A component that does not reach the outline.
  struct Floating {
    std::vector<uint32_t> members;  // vertices
    uint32_t exterior = kUnset;     // the cycle that runs around it from outside
    std::vector<uint32_t> holders;  // cycles that run around it
  };

  uint32_t localOf(uint32_t id);
  void orderOutgoing(uint32_t v, Predicates& predicates);
  void sortAround(uint32_t v, uint32_t* begin, uint32_t* end, bool fullCircle, Predicates& predicates);
  void traceCycles();
  void placeComponents(Predicates& predicates);
  void findFloating(Predicates& predicates);
  void findHolders(Predicates& predicates);
  uint32_t exteriorCycle(const std::vector<uint32_t>& component, Predicates& predicates);
  void traceLoops(Predicates& predicates);
  bool isBefore(uint32_t u, uint32_t v, Predicates& predicates) const;

  const CutVertices* vertices_ = nullptr;
  int axis_ = 0;
  size_t sides_ = 0;
  std::vector<uint32_t> ids_;                    // per local vertex
  std::vector<uint32_t> localTable_;             // sparse: vertex id to local vertex, valid where ids_ agrees
  std::vector<uint32_t> ends_;                   // per half-edge: origin
  std::vector<uint32_t> outOffsets_, out_, at_;  // outgoing half-edges of each vertex, counter-clockwise
  std::vector<uint32_t> nextOf_;                 // per half-edge, slits included
  std::vector<uint32_t> cycleOf_;                // per half-edge
  std::vector<uint32_t> cycleStarts_;            // a half-edge of each cycle
  std::vector<uint32_t> faceOf_;                 // per cycle
  std::vector<uint8_t> traced_;
  DisjointSets components_;
  std::vector<Floating> floating_;
  std::vector<uint8_t> isExterior_;    // per cycle
  std::vector<uint32_t> componentOf_;  // per vertex: index into floating_, or its size; only where some float
};

}  // namespace mandoline::detail
