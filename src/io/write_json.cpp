#include "io/json_members.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace detail {
namespace {

void writeGrid(OutputBuffer& out, const Grid& grid) {
  out.text(",\n\"grid\":{\"origin\":");
  writeArray(out, grid.origin);
  out.text(",\"spacing\":");
  if (grid.uniform) {
    writeArray(out, grid.spacing);
  } else {
    out.text("null");
  }
  out.text(",\"cells\":");
  writeArray(out, std::array<int64_t, 3>{grid.cells(0), grid.cells(1), grid.cells(2)});
  out.text(",\"planes\":");
  for (int d = 0; d < 3; ++d) {
    out.character(d == 0 ? '[' : ',');
    writeArray(out, grid.planes[d]);
  }
  out.text("]}");
}

/// The dense form of the runs of untouched cells, without ever having it: -1 stands for cells that are cut.
void writeGridCellRegion(OutputBuffer& out, const CutMesh& cutMesh) {
  const Grid& grid = cutMesh.grid;
  out.text(",\n\"gridCellRegion\":");
  char separator = '[';
  int64_t written = 0;
  const auto put = [&](int64_t to, int64_t region) {
    for (; written < to; ++written, separator = ',') {
      out.character(separator);
      out.number(region);
      out.advance();
    }
  };
  UntouchedCells(cutMesh).forEach([&](const UntouchedCells::Run& run) {
    const int64_t row = grid.cells(0) * (run.j + grid.cells(1) * run.k);
    put(row + run.begin, -1);
    put(row + run.end, run.region);
  });
  put(grid.cells(0) * grid.cells(1) * grid.cells(2), -1);
  out.text(separator == '[' ? "[]" : "]");
}

void writeNulls(OutputBuffer& out, std::string_view key, uint32_t count) {
  out.text(",\n\"");
  out.text(key);
  out.text("\":[");
  for (uint32_t i = 0; i < count; ++i) out.text(i == 0 ? "null" : ",null");
  out.character(']');
}

void putCutMesh(Meter& meter, const CutMesh& cutMesh) {
  OutputBuffer out(meter);
  out.text("{\"format\":\"mandoline-cut-mesh\",\n\"version\":2");
  writeGrid(out, cutMesh.grid);
  forEachArray(cutMesh, [&](const ArrayInfo& info, const auto& array) {
    if (info.per == Element::region && array.empty()) return writeNulls(out, info.name, cutMesh.regionCount);
    writeMember(out, info.name, array);
  });
  writeGridCellRegion(out, cutMesh);
  out.text(",\n\"triangleCount\":");
  out.number(cutMesh.triangleCount);
  out.text(",\n\"snapTolerance\":");
  out.number(cutMesh.snapTolerance);
  writeFingerprints(out, cutMesh);
  out.text("}\n");
  out.flush();
}

uint64_t countNumbers(const CutMesh& cutMesh) {
  const Grid& grid = cutMesh.grid;
  uint64_t count = uint64_t(grid.cells(0)) * uint64_t(grid.cells(1)) * uint64_t(grid.cells(2)) + 9;  // 9: origin, spacing, cells
  for (const std::vector<double>& planes : grid.planes) count += planes.size();
  forEachArray(cutMesh, [&](const ArrayInfo&, const auto& array) { count += array.size(); });
  return count;
}

}  // namespace
}  // namespace detail

void writeJson(const Sink& sink, const CutMesh& cutMesh, const RunOptions& options) {
  operators::refuseRefined(cutMesh);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options);
    meter.beginStage("write", 0, detail::countNumbers(cutMesh));
    detail::putCutMesh(meter, cutMesh);
  });
}

}  // namespace mandoline
