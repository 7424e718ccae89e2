#include "io/groups.h"
#include "io/json_members.h"
#include "io/selection.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace detail {
namespace {

void putCells(OutputBuffer& out, const CutMesh& cutMesh, const CellComplex& cells, const TriangleGroups* groups) {
  out.text("{\"format\":\"mandoline-cell-complex\",\n\"version\":1");
  const std::pair<std::string_view, uint32_t> counts[] = {
      {"cutVertices", cells.cutVertices}, {"cutFaces", cells.cutFaces}, {"cutCells", cells.cutCells}};
  for (const auto& [name, count] : counts) {
    out.text(",\n\"");
    out.text(name);
    out.text("\":");
    out.number(count);
  }
  forEachArray(cells, [&](const char* name, const auto& array) { writeMember(out, name, array); });
  writeMember(out, "faceTriangle", cutMesh.faceTriangle);
  writeFingerprints(out, cells);
  if (groups) writeGroups(out, *groups);
  out.text("}\n");
  out.flush();
}

}  // namespace
}  // namespace detail

void writeJson(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options) {
  detail::runCall("writing", [&] {
    detail::requireAll(options);
    operators::requireCellsOf(cutMesh, cells);
    const TriangleGroups* groups = detail::checkedGroups(options.groups, cutMesh.triangleCount);
    uint64_t numbers = cutMesh.faceTriangle.size() + (groups ? groups->triangleGroup.size() : 0);
    forEachArray(cells, [&](const char*, const auto& array) { numbers += array.size(); });
    detail::Meter meter(sink, options);
    meter.beginStage("write", 0, numbers);
    detail::OutputBuffer out(meter);
    detail::putCells(out, cutMesh, cells, groups);
  });
}

}  // namespace mandoline
