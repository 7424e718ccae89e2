#include "mandoline/slice.h"

#include "operators/require_cut_mesh.h"
#include "operators/slice/box_slicer.h"
#include "operators/slice/cell_slicer.h"

namespace mandoline {

std::vector<Slice> slices(const CutMesh& cutMesh, const std::array<double, 3>& normal, std::span<const double> offsets,
                          const SliceOptions& options) {
  using namespace operators;
  requireCutMesh(cutMesh);
  const ScaledSpace space(cutMesh.grid);
  const ScaledGrid grid(cutMesh.grid, space);
  const PlaneStack planes(normal, offsets, cutMesh.grid, space);
  const detail::Csr<uint32_t> cells = cellsCut(planes, grid, cutMesh);
  CellSlicer cellSlicer(cutMesh, space);
  BoxSlicer boxSlicer(cutMesh, grid);
  PolygonWriter writer(space);
  std::vector<Slice> result(offsets.size());
  for (size_t p = 0; p < planes.size(); ++p) {
    Points points(planes[p]);
    writer.start(points, result[planes.given(p)]);
    cellSlicer.run(planes[p], cells[p], points, writer);
    if (options.untouched) boxSlicer.run(planes[p], points, writer);
    writer.finish();
  }
  return result;
}

Slice slice(const CutMesh& cutMesh, const Plane& plane, const SliceOptions& options) {
  return std::move(slices(cutMesh, plane.normal, {&plane.offset, 1}, options)[0]);
}

}  // namespace mandoline
