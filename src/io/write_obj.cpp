#include "io/output_buffer.h"
#include "io/polygons.h"
#include "io/surface.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

class ObjWriter {
 public:
  ObjWriter(Meter& meter, const CutMesh& cutMesh) : out_(meter), cutMesh_(cutMesh), polygons_(cutMesh), number_(cutMesh.vertexCount()) {}

  void write(const WrittenSurface& surface) {
    for (uint32_t r = 0; r < cutMesh_.regionCount; ++r) {
      if (surface.of(r).empty()) continue;
      out_.text("g region_");
      out_.number(r);
      out_.character('\n');
      for (const uint32_t h : surface.of(r)) {
        polygons_.forEach(h / 2, [&](std::span<const uint32_t> polygon) { writePolygon(polygon, h % 2 != 0); });
        out_.advance();
      }
    }
    out_.flush();
  }

 private:
  /// Vertices are written where they are first used.
  void writePolygon(std::span<const uint32_t> polygon, bool reversed) {
    for (const uint32_t v : polygon) {
      if (number_[v] == 0) writeVertex(v);
    }
    out_.character('f');
    for (size_t i = 0; i < polygon.size(); ++i) {
      out_.character(' ');
      out_.number(number_[polygon[reversed ? polygon.size() - 1 - i : i]]);
    }
    out_.character('\n');
  }

  void writeVertex(uint32_t v) {
    number_[v] = ++written_;
    out_.character('v');
    for (int d = 0; d < 3; ++d) {
      out_.character(' ');
      out_.number(cutMesh_.positions[3 * size_t(v) + d]);
    }
    out_.character('\n');
  }

  OutputBuffer out_;
  const CutMesh& cutMesh_;
  Polygons polygons_;
  std::vector<uint32_t> number_;  // per vertex: its number in the file, from 1; 0 if not written yet
  uint32_t written_ = 0;
};

}  // namespace
}  // namespace detail

void writeObj(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options) {
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options);
    const detail::WrittenSurface surface = detail::surfaceOf({cutMesh, options});
    meter.beginStage("write", 0, surface.halfFaces.size());
    detail::ObjWriter(meter, cutMesh).write(surface);
  });
}

}  // namespace mandoline
