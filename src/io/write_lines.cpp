// Polylines for viewers.
#include "io/output_buffer.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using namespace detail;

void requireLines(std::span<const double> points, std::span<const uint32_t> offsets) {
  if (points.size() % 3 != 0) operators::refuse("The points must have three coordinates each.");
  if (offsets.empty() || offsets[0] != 0) operators::refuse("The offsets of the lines must begin with 0.");
  for (size_t l = 0; l + 1 < offsets.size(); ++l) {
    if (offsets[l + 1] < offsets[l] || offsets[l + 1] > points.size() / 3)
      operators::refuse("Line " + std::to_string(l) + " has points that do not exist.", int64_t(l));
  }
}

}  // namespace

void writeLines(const Sink& sink, std::span<const double> points, std::span<const uint32_t> offsets, const RunOptions& options) {
  requireLines(points, offsets);
  runCall("writing", [&] {
    Meter meter(sink, options);
    meter.beginStage("write", 0, points.size() / 3 + offsets.back());
    OutputBuffer out(meter);
    for (size_t i = 0; i < points.size(); i += 3) {
      out.character('v');
      for (size_t d = 0; d < 3; ++d) {
        out.character(' ');
        out.number(points[i + d]);
      }
      out.character('\n');
      out.advance();
    }
    for (size_t l = 0; l + 1 < offsets.size(); ++l) {
      if (offsets[l + 1] - offsets[l] < 2) continue;
      out.character('l');
      for (uint32_t i = offsets[l]; i < offsets[l + 1]; ++i) {
        out.character(' ');
        out.number(i + 1);
      }
      out.character('\n');
      out.advance(offsets[l + 1] - offsets[l]);
    }
    out.flush();
  });
}

}  // namespace mandoline
