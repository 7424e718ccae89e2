// The cross-section is chained together from the triangles of the faces: geometry only tells which side of the plane each vertex lies on,
// how the triangles lie around an edge that several of a cell share, and which loops are holes in which.
#include "operators/slice/cell_slicer.h"

namespace mandoline::operators {

void CellSlicer::run(uint32_t plane, Points& points, PolygonWriter& writer) {
  CutFaces& cut = faceCutter_.run(plane);
  edgePoints_.start(cuts_.planes[plane], points);
  pointOfEdge_.clear();
  for (const auto& edge : cut.pointEdges) pointOfEdge_.push_back(edgePoints_.pointOn(edge));
  tracer_.start(points.seen());
  const std::span<const uint32_t> cells = cuts_.cells[plane];
  for (size_t c = 0; c < cells.size(); ++c) {
    if (cut.cellFaces[c].empty()) continue;
    addLoopsOf(cut, c);
    addPolygons(cells[c], points, writer);
  }
}

void CellSlicer::addLoopsOf(const CutFaces& cut, size_t cell) {
  for (const uint32_t h : cut.cellFaces[cell]) {
    const CutFace& face = cut.faces[h / 2];
    for (uint32_t s = face.firstSegment; s < face.endSegment; ++s)
      tracer_.add(s, pointOfEdge_[cut.segments[s][h % 2]], pointOfEdge_[cut.segments[s][1 - h % 2]]);
  }
}

void CellSlicer::addPolygons(size_t cell, const Points& points, PolygonWriter& writer) {
  const detail::Csr<uint32_t>& loops = tracer_.run();
  if (loops.size() == 0) return;
  const detail::Csr<uint32_t>& polygons = nesting_.run(loops, points.seen());
  for (size_t p = 0; p < polygons.size(); ++p) {
    for (const uint32_t l : polygons[p]) writer.addLoop(loops[l]);
    const detail::Csr<uint32_t>& fill = slits_.remove(loops, polygons[p], points.seen());
    for (size_t l = 0; l < fill.size(); ++l) writer.addFillLoop(fill[l]);
    const int32_t* gridCell = &cutMesh_.cellGridCell[3 * cell];
    writer.endPolygon(int32_t(cell), {gridCell[0], gridCell[1], gridCell[2]}, cutMesh_.cellRegion[cell]);
  }
}

}  // namespace mandoline::operators
