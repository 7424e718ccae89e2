// Cutting a triangle mesh with a grid.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/intersections.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

struct CutOptions : RunOptions {
  /// Tri-vertices within this distance of an axial plane (in cells, below 0.5) are moved onto it before cutting.
  double snapTolerance = 0;
  Intersections intersections = Intersections::resolve;
};

/// How long a stage took.
struct StageTime {
  const char* stage;
  double ms;  ///< milliseconds

  static void fields(auto& self, const auto& f) {
    f("stage", self.stage);
    f("ms", self.ms);
  }
};

/// The parts of a mesh that is not closed and consistently oriented as a whole, after resolving; all 0 of one that is.
/// Triangles are one part where they need each other to close an edge: two boxes that touch along an edge are two parts, though they are
/// one component to inspect().
struct PartCounts {
  uint32_t winding = 0;    ///< closed and consistently oriented, so that they have winding numbers
  uint32_t parity = 0;     ///< each edge has an even number of their triangles, but they are not consistently oriented
  uint32_t open = 0;       ///< the others
  uint32_t openEdges = 0;  ///< edges with an odd number of triangles of an open part
  uint32_t holes = 0;      ///< connected sets of those

  static void fields(auto& self, const auto& f) {
    f("winding", self.winding);
    f("parity", self.parity);
    f("open", self.open);
    f("openEdges", self.openEdges);
    f("holes", self.holes);
  }
};

/// How a cut went.
struct CutStats {
  std::vector<StageTime> stages;  ///< in order
  double totalMs = 0;
  uint64_t exactFallbacks = 0;                           ///< signs that needed exact arithmetic
  uint32_t weldedVertices = 0;                           ///< tri-vertices that share their position with a lower one
  uint32_t zeroAreaTriangles = 0, outsideTriangles = 0;  ///< dropped
  uint32_t duplicateTriangles = 0;                       ///< have the same three vertices as a lower one
  PairCounts intersections;                              ///< pairs of triangles that meet; none with Intersections::assumeNone
  uint32_t intersectionCurves = 0;                       ///< connected curves along which others meet the insides of triangles
  uint32_t madeVertices = 0;                             ///< of the cut-mesh
  uint32_t snappedVertices = 0;                          ///< moved onto a plane by snapTolerance
  double largestSnap = 0;                                ///< farthest such move, in cells
  uint32_t flushedCoordinates = 0;                       ///< below 2^-200 of the largest, taken as 0
  PartCounts parts;                                      ///< of the input

  static void fields(auto& self, const auto& f) {
    f("stages", self.stages);
    f("totalMs", self.totalMs);
    f("exactFallbacks", self.exactFallbacks);
    f("weldedVertices", self.weldedVertices);
    f("zeroAreaTriangles", self.zeroAreaTriangles);
    f("outsideTriangles", self.outsideTriangles);
    f("duplicateTriangles", self.duplicateTriangles);
    f("intersections", self.intersections);
    f("intersectionCurves", self.intersectionCurves);
    f("madeVertices", self.madeVertices);
    f("snappedVertices", self.snappedVertices);
    f("largestSnap", self.largestSnap);
    f("flushedCoordinates", self.flushedCoordinates);
    f("parts", self.parts);
  }
};

struct CutResult {
  Error error;
  CutMesh mesh;  ///< empty unless ok
  CutStats stats;

  explicit operator bool() const { return error.status == Status::ok; }
};

/// Cuts the mesh with the grid (Algorithm 1 of the paper). Failures come back as a status with the offending elements; it throws nothing
/// but what options.progress throws.
CutResult cut(const MeshView& mesh, const Grid& grid, const CutOptions& options = {});

}  // namespace mandoline
