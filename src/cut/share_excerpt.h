// What one of several processes keeps of the prepared mesh: an excerpt with the triangles in the layers that it cuts, and the ids that the
// whole mesh has for what is in it. Numbers, which all processes have alike, go by these.
#pragma once

#include "cut/share_input.h"
#include "mandoline/cut_share.h"
#include "mesh/excerpt.h"

namespace mandoline::detail {

struct ShareExcerpt {
  Excerpt excerpt;
  std::vector<double> positions;         ///< 3 per tri-vertex of it: those of the user
  std::vector<uint32_t> firstCrossings;  ///< per tri-edge of it the whole's id of the first crossing
  uint32_t wholeVertices = 0;            ///< of the whole mesh and its edges: how many ids they have

  ShareExcerpt(const Prepared& whole, std::span<const uint32_t> kept) : excerpt(whole, kept) {}

  /// The whole's id of a vertex of the mesh or its edges.
  uint32_t wholeId(const CutVertices& vertices, VertexId v) const {
    if (vertices.isTriVertex(v)) return excerpt.vertices[v.number];
    const TriEdgeId edge = vertices.triEdge(v);
    return firstCrossings[edge.number] + (v.number - vertices.crossingOffsets[edge.number].number);
  }
  /// Puts the whole's ids in the place of the excerpt's.
  void nameByWhole(CutMesh& cutMesh) const;
  void nameByWhole(Error& error) const;
};

/// Leaves to a state, whose layers are known and which has its input only, an excerpt of the mesh; what the result tells of all triangles
/// is noted. After that the whole mesh is not needed. `mesh` is that of the user.
MANDOLINE_SHARED std::unique_ptr<ShareExcerpt> takeExcerpt(const MeshView& mesh, CutState& state);
/// The same for a share that has no more of the mesh than its input, which is not needed after that.
std::unique_ptr<ShareExcerpt> takeInputExcerpt(ShareInput& from, CutState& state);

}  // namespace mandoline::detail
