// The surface is all there: area of each triangle's faces, reasons of dropped triangles.

#include "base/csr.h"
#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

/// A triangle seen along the dominant axis of its normal, in roundings relative to its first corner.
struct View {
  Vec3 origin, corners[3];
  int axis, sign;
};

View look(const Context& context, uint32_t t) {
  View view;
  view.origin = context.corner(t, 0);
  for (int i = 0; i < 3; ++i) view.corners[i] = context.inRoundings(context.corner(t, i), view.origin);
  view.axis = dominantAxis(cross(view.corners[1], view.corners[2]));
  view.sign = context.sideOf(t, view.axis);
  return view;
}

/// An area, and how much of it changes when its boundary moves by one rounding.
struct Area {
  double value = 0, noise = 0;
  void add(const Area& other) { value += other.value, noise += other.noise; }
};

Area areaOf(const Polygon& polygon, const View& view) {
  const int e = (view.axis + 1) % 3, f = (view.axis + 2) % 3;
  Area area;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area.value += view.sign * cross(a - polygon[0], b - polygon[0])[view.axis] / 2;
    area.noise += std::fabs(b[e] - a[e]) + std::fabs(b[f] - a[f]) + 1;
  }
  return area;
}

/// A face of a triangle; sign as in faceParentSigns.
struct Part {
  uint32_t face;
  int32_t sign;
};
using PartsOfTriangles = detail::Csr<Part>;

PartsOfTriangles partsOfTriangles(const Context& context) {
  const CutMesh& cut = context.cut;
  std::vector<Part> parts(cut.faceParents.size());
  for (size_t f = 0; f < cut.faceCount(); ++f) {
    for (uint32_t i = cut.faceParentOffsets[f]; i < cut.faceParentOffsets[f + 1]; ++i) parts[i] = {uint32_t(f), cut.faceParentSigns[i]};
  }
  return detail::groupBy<Part>(
      context.mesh.triangleCount(), parts.size(), [&](size_t i) { return size_t(cut.faceParents[i]); }, [&](size_t i) { return parts[i]; });
}

/// The findings for a part of the triangles.
struct Findings {
  Tally area{"surfaceArea", kTolerance}, droppedTriangles{"droppedTriangles"};
};

/// One triangle by itself.
class TriangleCheck {
 public:
  TriangleCheck(const Context& context, const PartsOfTriangles& parts, Findings& findings) : x_(context), parts_(parts), found_(findings) {}

  void checkArea(uint32_t t) {
    const View view = look(x_, t);
    const Area expected = areaInBox(t, view), found = areaOfFaces(t, view);
    const double difference = std::fabs(found.value - expected.value);
    const double roundings = difference > 0 ? difference / (found.noise + expected.noise) : 0;
    found_.area.measure({roundings, difference / expected.value}, "triangle", t,
                        "is covered by faces whose area differs from its own by {}");
    if (parts_[t].empty()) found_.droppedTriangles.violate("triangle", t, "is not dropped, but has no face");
  }

  void checkDropped(uint32_t t) {
    if (!x_.hasArea(t)) return;
    const Area expected = areaInBox(t, look(x_, t));
    if (x_.triangleInBox(t) || expected.value > kTolerance * expected.noise)
      found_.droppedTriangles.violate("triangle", t, "is dropped without a reason");
  }

 private:
  Area areaInBox(uint32_t t, const View& view) const {
    Polygon polygon(view.corners, view.corners + 3);
    if (!x_.triangleInBox(t)) {
      Vec3 low, high;
      for (int d = 0; d < 3; ++d) low[d] = x_.planes()[size_t(d)].front(), high[d] = x_.planes()[size_t(d)].back();
      clipToBox(polygon, x_.inRoundings(low, view.origin), x_.inRoundings(high, view.origin));
    }
    return areaOf(polygon, view);
  }

  Polygon loopPolygon(std::span<const uint32_t> loop, const View& view) const {
    Polygon polygon;
    for (const uint32_t v : loop) polygon.push_back(x_.inRoundings(x_.vertex(v), view.origin));
    return polygon;
  }

  Area areaOfFaces(uint32_t t, const View& view) const {
    Area area;
    for (const Part& part : parts_[t]) {
      for (const std::span<const uint32_t> loop : x_.cut.loops(part.face)) {
        Area its = areaOf(loopPolygon(loop, view), view);
        its.value *= part.sign;
        area.add(its);
      }
    }
    return area;
  }

  const Context& x_;
  const PartsOfTriangles& parts_;
  Findings& found_;
};

}  // namespace

SurfaceChecks checkSurface(const Context& context, detail::Monitor& monitor) {
  const PartsOfTriangles parts = partsOfTriangles(context);
  const auto work = [&](Findings& findings, size_t begin, size_t end) {
    TriangleCheck check(context, parts, findings);
    for (uint32_t t = uint32_t(begin); t < end; ++t) {
      if (context.dropped[t]) {
        check.checkDropped(t);
      } else {
        check.checkArea(t);
      }
    }
  };
  Findings all;
  for (const Findings& part : detail::forChunks<Findings>(context.mesh.triangleCount(), monitor, work)) {
    all.area.merge(part.area);
    all.droppedTriangles.merge(part.droppedTriangles);
  }
  return {all.area.finish(), all.droppedTriangles.finish()};
}

}  // namespace mandoline::validation
