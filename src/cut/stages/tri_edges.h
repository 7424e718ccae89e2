// Stage 2, tri-edges (paper, 3.3 and 4.1.1): unique tri-edges of the kept triangles and their crossings with the axial planes, in order.
//
// In: Input. Out: TriEdges and the first two ranges of CutVertices. Drops duplicate triangles (Appendix A) on the way.
// After it: crossings of several planes at one point are one vertex; the slabs of every crossing are complete and exact.
#pragma once

#include <vector>

#include "base/csr.h"
#include "cut/predicates/cut_vertices.h"

namespace mandoline::detail {

/// A piece of a cut-edge's line that lies in one grid-face: what the planar graph of that grid-face is made of.
struct FaceEdge {
  Slab element;  ///< the grid-face: one entry is even
  uint32_t from, to;
};

struct TriEdges {
  std::vector<std::array<uint32_t, 2>> ends;  ///< tri-vertices, lower one first; ascending
  std::vector<uint32_t> sideEdges;            ///< 3 per input triangle: tri-edge of side (i, i + 1), or kStitched + index into stitched
  Csr<uint32_t> stitched;                     ///< tri-edges that together make a stitched side, from its lower tri-vertex to its higher
  std::vector<uint32_t> crossingOffsets;      ///< per tri-edge: its crossings' ids start here, from its lower end on; unused ids end them
  std::vector<FaceEdge> inPlane;              ///< pieces of tri-edges that lie in a grid-face

  static constexpr uint32_t kStitched = 1u << 31;

  /// Calls f(tri-edge, whether it is run through from its lower end) for the tri-edges of a side, in the triangle's direction.
  template <class F>
  void forSide(const Input& input, uint32_t triangle, int side, const F& f) const {
    const auto& v = input.triangles[triangle];
    const bool forward = v[side] < v[(side + 1) % 3];
    const uint32_t edge = sideEdges[3 * size_t(triangle) + side];
    if (edge < kStitched) return f(edge, forward);
    const auto edges = stitched[edge - kStitched];
    for (size_t i = 0; i < edges.size(); ++i) {
      const size_t at = forward ? i : edges.size() - 1 - i;
      const bool sameWay = (ends[edges[at]][0] == (at == 0 ? std::min(v[side], v[(side + 1) % 3]) : commonEnd(edges[at - 1], edges[at])));
      f(edges[at], forward == sameWay);
    }
  }
  uint32_t commonEnd(uint32_t e, uint32_t f) const {
    return ends[e][0] == ends[f][0] || ends[e][0] == ends[f][1] ? ends[e][0] : ends[e][1];
  }
};

/// The surface and the cut-vertices on it, which point into the others: so it stays where it is.
struct Surface {
  Input input;
  TriEdges edges;
  CutVertices vertices;

  Surface() = default;
  Surface(const Surface&) = delete;
};

/// From `surface.input` the rest of the surface.
void cutTriEdges(Surface& surface, Run& run);

}  // namespace mandoline::detail
