// Outlines at heights: SVG and DXF for drawings and cutters, OBJ for everything else.
#include <algorithm>
#include <cmath>

#include "io/output_buffer.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"
#include "operators/slice/plane_stack.h"

namespace mandoline {
namespace detail {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A closed outline or an open line of a layer.
struct Line {
  std::span<const uint32_t> points;
  uint32_t region;
  bool closed;
};

/// Calls visit(lines of one polygon, or one slit) for what is written of a layer.
template <class Visit>
void forEachShape(const Outlines& layer, const WriteOptions& options, const Visit& visit) {
  std::vector<Line> lines;
  for (size_t p = 0; p < layer.polygonCount(); ++p) {
    if (!options.hasRegion(layer.polygonRegion[p])) continue;
    lines.clear();
    for (size_t l = layer.polygonLoopOffsets[p]; l < layer.polygonLoopOffsets[p + 1]; ++l) {
      const uint32_t begin = layer.loopOffsets[l], end = layer.loopOffsets[l + 1];
      lines.push_back({{layer.loopPoints.data() + begin, end - begin}, layer.polygonRegion[p], true});
    }
    visit(lines);
  }
  for (size_t s = 0; s < layer.slitCount(); ++s) {
    if (!options.hasRegion(layer.slitRegion[s])) continue;
    const uint32_t begin = layer.slitOffsets[s], end = layer.slitOffsets[s + 1];
    const bool closed = end - begin > 2 && layer.slitPoints[begin] == layer.slitPoints[end - 1];
    lines.assign(1, {{layer.slitPoints.data() + begin, end - begin - (closed ? 1 : 0)}, layer.slitRegion[s], closed});
    visit(lines);
  }
}

Vector pointOf(const Outlines& layer, uint32_t point) {
  const double* p = layer.positions.data() + 3 * size_t(point);
  return {p[0], p[1], p[2]};
}

class OutlineWriter {
 public:
  OutlineWriter(Meter& meter, const OutlineStack& stack, const WriteOptions& options) : out_(meter), stack_(stack), options_(options) {}

  void writeSvg() {
    const PlaneAxes axes = planeAxes(stack_.normal);
    std::array<double, 2> min = {INFINITY, INFINITY}, max = {-INFINITY, -INFINITY};
    const auto place = [&](const Outlines& layer, uint32_t point) -> std::array<double, 2> {
      const Vector p = pointOf(layer, point);
      return {dot(p, axes.right), -dot(p, axes.up)};  // SVG's y points down
    };
    forEachPoint([&](const Outlines& layer, uint32_t point) {
      const auto p = place(layer, point);
      for (size_t d = 0; d < 2; ++d) {
        min[d] = std::min(min[d], p[d]);
        max[d] = std::max(max[d], p[d]);
      }
    });
    if (min[0] > max[0]) min = max = {0, 0};
    out_.text("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"");
    putNumbers({min[0], min[1], max[0] - min[0], max[1] - min[1]});
    out_.text("\">\n<style>path { fill: none; stroke: #000; stroke-width: 1; vector-effect: non-scaling-stroke }</style>\n");
    for (size_t i = 0; i < stack_.layers.size(); ++i) {
      out_.text("<g data-height=\"");
      out_.number(height(i));
      out_.text("\">\n");
      forEachShape(stack_.layers[i], options_, [&](const std::vector<Line>& lines) {
        out_.text("<path data-region=\"");
        out_.number(lines[0].region);
        out_.text("\" d=\"");
        for (const Line& line : lines) {
          char command = 'M';
          for (const uint32_t point : line.points) {
            out_.character(command);
            const auto p = place(stack_.layers[i], point);
            putNumbers({p[0], p[1]});
            command = 'L';
          }
          if (line.closed) out_.character('Z');
        }
        out_.text("\"/>\n");
      });
      out_.text("</g>\n");
      out_.advance();
    }
    out_.text("</svg>\n");
    out_.flush();
  }

  /// DXF of release 12, which everything reads: polylines in space, one layer per region.
  void writeDxf() {
    out_.text("0\nSECTION\n2\nENTITIES\n");
    for (const Outlines& layer : stack_.layers) {
      forEachShape(layer, options_, [&](const std::vector<Line>& lines) {
        for (const Line& line : lines) writeDxfLine(layer, line);
      });
      out_.advance();
    }
    out_.text("0\nENDSEC\n0\nEOF\n");
    out_.flush();
  }

  void writeObj() {
    uint64_t written = 0;
    for (size_t i = 0; i < stack_.layers.size(); ++i) {
      const Outlines& layer = stack_.layers[i];
      forEachShape(layer, options_, [&](const std::vector<Line>& lines) {
        out_.text("g height_");
        out_.number(height(i));
        out_.text("_region_");
        out_.number(lines[0].region);
        out_.character('\n');
        for (const Line& line : lines) {
          for (const uint32_t point : line.points) {
            const Vector p = pointOf(layer, point);
            out_.text("v ");
            putNumbers({p[0], p[1], p[2]});
            out_.character('\n');
          }
          out_.character('l');
          for (uint64_t n = 0; n < line.points.size() + (line.closed ? 1 : 0); ++n) {
            out_.character(' ');
            out_.number(written + 1 + n % line.points.size());
          }
          out_.character('\n');
          written += line.points.size();
        }
      });
      out_.advance();
    }
    out_.flush();
  }

 private:
  /// Distance of a plane from the origin, along the normal.
  double height(size_t layer) const { return stack_.offsets[layer] / std::sqrt(dot(stack_.normal, stack_.normal)); }

  template <class Visit>
  void forEachPoint(const Visit& visit) const {
    for (const Outlines& layer : stack_.layers) {
      forEachShape(layer, options_, [&](const std::vector<Line>& lines) {
        for (const Line& line : lines) {
          for (const uint32_t point : line.points) visit(layer, point);
        }
      });
    }
  }

  void writeDxfLine(const Outlines& layer, const Line& line) {
    const auto putHead = [&](std::string_view entity) {
      out_.text("0\n");
      out_.text(entity);
      out_.text("\n8\nregion_");
      out_.number(line.region);
      out_.character('\n');
    };
    putHead("POLYLINE");
    out_.text(line.closed ? "66\n1\n70\n9\n" : "66\n1\n70\n8\n");  // vertices follow; in space, and closed
    for (const uint32_t point : line.points) {
      putHead("VERTEX");
      const Vector p = pointOf(layer, point);
      for (size_t d = 0; d < 3; ++d) {
        out_.number(int(10 * (d + 1)));
        out_.character('\n');
        out_.number(p[d]);
        out_.character('\n');
      }
      out_.text("70\n32\n");
    }
    putHead("SEQEND");
  }

  void putNumbers(std::initializer_list<double> numbers) {
    for (const double* n = numbers.begin(); n != numbers.end(); ++n) {
      if (n != numbers.begin()) out_.character(' ');
      out_.number(*n);
    }
  }

  OutputBuffer out_;
  const OutlineStack& stack_;
  const WriteOptions& options_;
};

void requireFitting(const OutlineStack& stack, const WriteOptions& options) {
  operators::requireNormal(stack.normal);
  if (stack.layers.size() != stack.offsets.size()) {
    operators::refuse("There are " + std::to_string(stack.layers.size()) + " layers for " + std::to_string(stack.offsets.size()) +
                      " offsets.");
  }
  if (options.regions.empty()) return;
  for (const Outlines& layer : stack.layers) {
    for (const std::vector<uint32_t>* regions : {&layer.polygonRegion, &layer.slitRegion}) {
      for (const uint32_t region : *regions) {
        if (region >= options.regions.size()) {
          operators::refuse("regions must have one flag for each region, but has " + std::to_string(options.regions.size()) +
                                " and none for region " + std::to_string(region) + ".",
                            region);
        }
      }
    }
  }
}

}  // namespace
}  // namespace detail

void writeOutlines(const Sink& sink, FileFormat format, const OutlineStack& stack, const WriteOptions& options) {
  detail::requireFitting(stack, options);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options);
    meter.beginStage("write", 0, stack.layers.size());
    detail::OutlineWriter writer(meter, stack, options);
    switch (format) {
      case FileFormat::svg:
        return writer.writeSvg();
      case FileFormat::dxf:
        return writer.writeDxf();
      case FileFormat::obj:
        return writer.writeObj();
      default:
        throw FileError(std::string("outlines can't be written as .") + name(format));
    }
  });
}

}  // namespace mandoline
