// What a mesh numbers. Kinds don't mix.
#pragma once

#include "base/id.h"

namespace mandoline::detail {

using TriangleId = Id<struct TriangleTag>;  ///< by place in the input
using VertexId = Id<struct VertexTag>;  ///< tri-vertices by place in the input, then made vertices; in a cut more follow: see CutVertices
using TriEdgeId = Id<struct TriEdgeTag>;

}  // namespace mandoline::detail
