// The defects of a mesh as lines, for viewers.
#include "io/output_buffer.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using namespace detail;

void requireSameMesh(const MeshView& mesh, const MeshInfo& info) {
  if (info.vertices != mesh.vertexCount() || info.triangles != mesh.triangleCount())
    operators::refuse("The defects are not those of this mesh: that one had " + std::to_string(info.vertices) + " vertices and " +
                      std::to_string(info.triangles) + " triangles.");
  for (const uint32_t v : info.defectVertices) {
    if (v >= mesh.vertexCount())
      operators::refuse("The defects are not those of this mesh: there is no vertex " + std::to_string(v) + ".", v);
  }
}

}  // namespace

void writeDefects(const Sink& sink, const MeshView& mesh, const MeshInfo& info, const RunOptions& options) {
  requireSameMesh(mesh, info);
  runCall("writing", [&] {
    Meter meter(sink, options);
    meter.beginStage("write", 0, info.defectCount());
    OutputBuffer out(meter);
    std::vector<uint32_t> placeOf(mesh.vertexCount(), 0);  // in the file, from 1 on; 0 for vertices that are not in it
    uint32_t written = 0;
    const auto putVertex = [&](uint32_t v) {
      if (placeOf[v] != 0) return;
      placeOf[v] = ++written;
      out.text("v");
      for (size_t d = 0; d < 3; ++d) {
        out.character(' ');
        out.number(mesh.positions[3 * size_t(v) + d]);
      }
      out.character('\n');
    };
    for (const uint32_t v : info.defectVertices) putVertex(v);
    for (size_t kind = 0; kind < kEdgeDefects; ++kind) {
      bool isFirst = true;
      for (size_t d = 0; d < info.defectCount(); ++d) {
        if (info.defectKind[d] != EdgeDefect(kind)) continue;
        if (isFirst) {
          out.text("g ");
          out.text(name(EdgeDefect(kind)));
          out.character('\n');
        }
        isFirst = false;
        out.text("l ");
        out.number(placeOf[info.defectVertices[2 * d]]);
        out.character(' ');
        out.number(placeOf[info.defectVertices[2 * d + 1]]);
        out.character('\n');
        out.advance();
      }
    }
    out.flush();
  });
}

}  // namespace mandoline
