#include "mesh/inspect_plain.h"

#include <utility>

namespace mandoline::detail {

MeshInfo inspectPlain(MeshInfo arrays, const BandFindings& found, const PartCounts& parts) {
  MeshInfo info = std::move(arrays);
  info.closed = found.edges.open == 0;
  info.oriented = found.edges.closed;
  info.openEdges = found.edges.open;
  info.inconsistentEdges = found.edges.inconsistent;
  info.components = size_t(parts.winding) + parts.parity + parts.open;
  info.weldedVertices += found.weldedVertices;
  return info;
}

}  // namespace mandoline::detail
