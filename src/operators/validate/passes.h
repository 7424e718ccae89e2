// The passes of validate(). Each sees what the passes before it have returned, and reports its checks.
#pragma once

#include "base/parallel.h"
#include "operators/validate/context.h"
#include "operators/validate/input_topology.h"
#include "operators/validate/tally.h"
#include "operators/validate/triangle_bins.h"

namespace mandoline::validation {

/// Cut-vertices (paper, 3.2) against their positions, the planes and the input.
struct VertexChecks {
  Check vertices, positions;
};
VertexChecks checkVertices(const Context& context, detail::Monitor& monitor);

/// Cut-faces (paper, 3.4), their two sides, and grid cell isolation (5.6).
struct FaceChecks {
  Check faces, planarity, orientation, halfFaces, isolation;
};
FaceChecks checkFaces(const Context& context, detail::Monitor& monitor);

/// A point known to lie in a region, for comparison with the input's own winding number.
struct Sample {
  Vec3 position;
  uint32_t region;
  const char* kind;  ///< what it lies in
  int64_t element;
};

/// What is checked within each grid cell: its cut-cells are closed, conforming, of one shell each, and fill it (paper, 3.5, 4.4 and 5.6).
struct GridCellChecks {
  Check closedCells, facingFaces, conforming, crossings, gridFaces, connected, distinctCells, cellVolume, gridCellVolume, gridFaceArea,
      partition;
  std::vector<double> cellVolumes;  ///< per cut-cell, scaled
  std::vector<Sample> samples;      ///< in cut-cells
};
GridCellChecks checkGridCells(const Context& context, detail::Monitor& monitor);

/// Area of each triangle's faces (paper, 5.6), reasons of dropped triangles.
struct SurfaceChecks {
  Check area, droppedTriangles;
};
SurfaceChecks checkSurface(const Context& context, detail::Monitor& monitor);

/// The stencil (paper, 4.3.1) and the regions.
struct RegionChecks {
  Check stencil, regions;
};
RegionChecks checkRegions(const Context& context, const TriangleBins& bins);

/// Piecewise constant winding number and input volume (paper, 5.6).
struct WindingChecks {
  Check windingNumber, inputVolume;
};
WindingChecks checkWinding(const Context& context, const InputTopology& topology, const TriangleBins& bins,
                           const GridCellChecks& gridCells);

}  // namespace mandoline::validation
