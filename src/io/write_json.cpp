#include "io/output_buffer.h"

namespace mandoline {
namespace detail {
namespace {

template <class Array>
void writeArray(OutputBuffer& out, const Array& array) {
  char separator = '[';
  for (const auto& item : array) {
    out.character(separator);
    if constexpr (sizeof item == 1) {
      out.number(int(item));  // not a character
    } else {
      out.number(item);
    }
    separator = ',';
  }
  if (separator == '[') out.character(separator);
  out.character(']');
}

template <class Array>
void writeMember(OutputBuffer& out, std::string_view key, const Array& array) {
  out.text(",\n\"");
  out.text(key);
  out.text("\":");
  writeArray(out, array);
}

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

void writeWinding(OutputBuffer& out, const CutMesh& cutMesh) {
  if (cutMesh.hasWinding) return writeMember(out, "regionWinding", cutMesh.regionWinding);
  out.text(",\n\"regionWinding\":[");
  for (uint32_t r = 0; r < cutMesh.regionCount; ++r) out.text(r == 0 ? "null" : ",null");
  out.character(']');
}

}  // namespace
}  // namespace detail

void writeJson(const Sink& sink, const CutMesh& cutMesh) {
  using detail::writeMember;
  detail::OutputBuffer out(sink);
  out.text("{\"format\":\"mandoline-cut-mesh\",\n\"version\":1");
  detail::writeGrid(out, cutMesh.grid);
  writeMember(out, "positions", cutMesh.positions);
  writeMember(out, "vertexCell", cutMesh.vertexCell);
  writeMember(out, "vertexMask", cutMesh.vertexMask);
  writeMember(out, "vertexTriVertex", cutMesh.vertexTriVertex);
  writeMember(out, "loopOffsets", cutMesh.loopOffsets);
  writeMember(out, "loopVertices", cutMesh.loopVertices);
  writeMember(out, "faceLoopOffsets", cutMesh.faceLoopOffsets);
  writeMember(out, "faceTriangle", cutMesh.faceTriangle);
  writeMember(out, "faceAxis", cutMesh.faceAxis);
  writeMember(out, "facePlane", cutMesh.facePlane);
  writeMember(out, "cellHalfFaceOffsets", cutMesh.cellHalfFaceOffsets);
  writeMember(out, "cellHalfFaces", cutMesh.cellHalfFaces);
  writeMember(out, "cellGridCell", cutMesh.cellGridCell);
  writeMember(out, "cellRegion", cutMesh.cellRegion);
  writeMember(out, "gridCellRegion", cutMesh.gridCellRegion());
  detail::writeWinding(out, cutMesh);
  writeMember(out, "droppedTriangles", cutMesh.droppedTriangles);
  out.text(",\n\"triangleCount\":");
  out.number(cutMesh.triangleCount);
  out.text("}\n");
  out.flush();
}

}  // namespace mandoline
