// A grid-face that chains of cut-edges cross from side to side, as nearly all do. There the faces follow from how the edges are connected:
// nothing has to be ordered, and no predicate asked.
#pragma once

#include <span>
#include <vector>

#include "base/csr.h"

namespace mandoline::detail {

/// A vertex of one grid-face, numbered there.
using GraphVertex = Id<struct GraphVertexTag>;

class Chains {
 public:
  /// As in PlanarGraph: vertices 0 .. sides - 1 are the outline's, `ends` holds two for each edge, and edge i < sides runs along the
  /// outline. False, without loops to use, unless every edge inside is on a chain between two vertices of the outline, all chains are
  /// disjoint, and each parts two faces.
  bool trace(uint32_t sides, std::span<const GraphVertex> ends, size_t vertices);

  /// One for each face: those that PlanarGraph finds, in its order.
  Csr<GraphVertex> loops;
  /// 2 per edge: the faces left and right of it, in its direction; of the outline, which runs counter-clockwise, the left one alone.
  std::vector<uint32_t> beside;

 private:
  bool link(uint32_t sides, std::span<const GraphVertex> ends, size_t vertices);
  bool traceFace(uint32_t first, uint32_t sides, std::span<const GraphVertex> ends);

  static constexpr uint32_t kNone = ~0u;

  std::vector<uint32_t> links_;  // per vertex: its edges inside of the square, up to two
  std::vector<uint8_t> traced_;  // per edge of the outline
  size_t passes_ = 0;            // of edges inside, one for each side
};

}  // namespace mandoline::detail
