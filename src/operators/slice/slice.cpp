#include "mandoline/slice.h"

#include "operators/slice/box_slicer.h"
#include "operators/slice/cell_slicer.h"

namespace mandoline {

std::vector<Slice> slices(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets,
                          const SliceOptions& options) {
  using namespace operators;
  const PlanarCuts cuts(cutMesh, normal, offsets);
  CellSlicer cellSlicer(cutMesh, cuts);
  BoxSlicer boxSlicer(cutMesh, cuts.grid);
  Points points;
  PolygonWriter writer(cuts.space);
  std::vector<Slice> result(offsets.size());
  for (uint32_t p = 0; p < cuts.planes.size(); ++p) {
    points.start(cuts.planes[p]);
    writer.start(points, result[cuts.planes.given(p)]);
    cellSlicer.run(p, points, writer);
    if (options.untouched) boxSlicer.run(cuts.planes[p], points, writer);
    writer.finish();
  }
  return result;
}

Slice slice(const CutMesh& cutMesh, const Plane& plane, const SliceOptions& options) {
  return std::move(slices(cutMesh, plane.normal, {&plane.offset, 1}, options)[0]);
}

}  // namespace mandoline
