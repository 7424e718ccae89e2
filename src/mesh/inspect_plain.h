// What inspect() counts, from what is known of a plain mesh: see mesh_band.h.
#pragma once

#include "base/shared.h"
#include "mandoline/inspect.h"
#include "mesh/mesh_band.h"

namespace mandoline::detail {

/// What all bands have found together.
struct BandFindings {
  BandEdges edges;
  uint64_t weldedVertices = 0;
};

/// Without the arrays of components and defects, of a mesh of which no tri-edge has more than two triangles. `arrays`: its box and counts,
/// and what is to be said of vertices that no triangle has, which bands leave out.
MANDOLINE_SHARED MeshInfo inspectPlain(MeshInfo arrays, const BandFindings& found, const PartCounts& parts);

}  // namespace mandoline::detail
