// The cut of a plane through cut-cells.
#pragma once

#include "operators/slice/face_cutter.h"
#include "operators/slice/loop_tracer.h"
#include "operators/slice/nesting.h"
#include "operators/slice/polygon_writer.h"
#include "operators/slice/slits.h"

namespace mandoline::operators {

/// One plane at a time; the buffers are kept from plane to plane.
class CellSlicer {
 public:
  CellSlicer(const CutMesh& cutMesh, const PlanarCuts& cuts)
      : cutMesh_(cutMesh), cuts_(cuts), faceCutter_(cutMesh, cuts), edgePoints_(cutMesh, cuts.space) {}

  /// Adds the points and polygons of the cut-cells.
  void run(uint32_t plane, Points& points, PolygonWriter& writer);

 private:
  void addLoopsOf(const CutFaces& cut, size_t cell);
  void addPolygons(size_t cell, const Points& points, PolygonWriter& writer);

  const CutMesh& cutMesh_;
  const PlanarCuts& cuts_;
  FaceCutter faceCutter_;
  EdgePoints edgePoints_;
  std::vector<uint32_t> pointOfEdge_;
  LoopTracer tracer_;
  Nesting nesting_;
  Slits slits_;
};

}  // namespace mandoline::operators
