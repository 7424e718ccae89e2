// What the outlines of regions are made of: arcs between points, with the region to their left.
#pragma once

#include "mandoline/cut_mesh.h"
#include "operators/slice/box_cut.h"
#include "operators/slice/cut_boxes.h"
#include "operators/slice/face_cutter.h"
#include "operators/slice/points.h"

namespace mandoline::operators {

/// A piece of a region's outline. All pieces of a line in one direction lie on one straight line.
struct RegionArc {
  uint32_t region;
  uint32_t start, end;
  int32_t line;  ///< the triangle that is cut, or ~(3 * plane + axis) for an axial plane
  bool isSlit;   ///< one for both directions: the region is on both sides
};

/// One plane at a time; the buffers are kept from plane to plane.
class RegionArcs {
 public:
  RegionArcs(const CutMesh& cutMesh, const PlanarCuts& cuts);

  /// The arcs of all regions, by region, and their points. Holds until the next call.
  const std::vector<RegionArc>& run(uint32_t plane, Points& points);

 private:
  bool liesOnSide(const std::array<uint32_t, 2>& edge, GridEdge& gridEdge) const;
  void addFaces(const CutFaces& cut);
  int64_t regionBeside(const CutFace& face, int side) const;
  bool isBorder(const GridCell& gridCell, uint32_t region, int axis, int upper) const;
  void addBoxes(const CuttingPlane& plane, GridPoints& gridPoints);
  void addBox(const GridCell& gridCell, uint32_t region, const CuttingPlane& plane, GridPoints& gridPoints);
  void add(const RegionArc& arc);

  const CutMesh& cutMesh_;
  const PlanarCuts& cuts_;
  FaceCutter faceCutter_;
  EdgePoints edgePoints_;
  CutBoxes boxes_;
  BoxCuts boxCuts_;
  std::vector<uint32_t> pointOfEdge_;
  std::vector<RegionArc> arcs_;
};

}  // namespace mandoline::operators
