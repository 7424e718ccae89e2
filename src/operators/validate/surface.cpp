// The surface is all there: area of each triangle's faces, reasons of dropped triangles.
#include <algorithm>

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
  view.sign = turn(context.corner(t, 0), context.corner(t, 1), context.corner(t, 2), view.axis);
  return view;
}

/// An area, and what a move of its boundary by one rounding changes of it.
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

using FacesOfTriangles = detail::Csr<uint32_t>;

/// Groups the faces by triangle; those of none come last.
FacesOfTriangles facesOfTriangles(const Context& context) {
  const std::vector<int32_t>& triangleOf = context.cut.faceTriangle;
  const size_t none = context.mesh.triangleCount();
  return detail::groupBy<uint32_t>(
      none + 1, triangleOf.size(), [&](size_t f) { return triangleOf[f] < 0 ? none : size_t(triangleOf[f]); },
      [](size_t f) { return uint32_t(f); });
}

/// What a part of the triangles has shown.
struct Findings {
  Tally area{"surfaceArea", kTolerance}, droppedTriangles{"droppedTriangles"};
  std::vector<uint32_t> overlapping;  // triangles
};

/// One triangle by itself.
class TriangleCheck {
 public:
  TriangleCheck(const Context& context, const TriangleBins& bins, const FacesOfTriangles& faces, Findings& findings)
      : x_(context), bins_(bins), faces_(faces), found_(findings) {}

  void checkArea(uint32_t t) {
    const View view = look(x_, t);
    const Area expected = areaInBox(t, view);
    Area found = areaOfFaces(t, view);
    const auto roundings = [&] {
      const double difference = std::fabs(found.value - expected.value);
      return difference > 0 ? difference / (found.noise + expected.noise) : 0;
    };
    if (!(roundings() <= kTolerance)) found.add(areaUnderOthers(t, view));
    const double share = std::fabs(found.value - expected.value) / expected.value;
    found_.area.measure({roundings(), share}, "triangle", t, "is covered by faces whose area differs from its own by {}");
  }

  void checkDropped(uint32_t t) {
    const View view = look(x_, t);
    const Area expected = areaInBox(t, view);
    if (!x_.triangleInBox(t) && expected.value <= kTolerance * expected.noise) return;
    const Area covered = areaUnderOthers(t, view);
    if (covered.value <= 0 || covered.value < expected.value - kTolerance * (expected.noise + covered.noise)) {
      found_.droppedTriangles.violate("triangle", t, "is dropped without a reason");
    }
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
    for (const uint32_t face : faces_[t]) {
      for (const std::span<const uint32_t> loop : x_.cut.loops(face)) area.add(areaOf(loopPolygon(loop, view), view));
    }
    return area;
  }

  /// Area of t under faces of other triangles in its plane.
  Area areaUnderOthers(uint32_t t, const View& view) {
    Vec3 low = x_.corner(t, 0), high = low;
    for (int i = 1; i < 3; ++i) {
      for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x_.corner(t, i)[d]), high[d] = std::max(high[d], x_.corner(t, i)[d]);
    }
    others_.clear();
    bins_.forTriangles(low, high, [&](uint32_t other) {
      if (other != t && !x_.dropped[other]) others_.push_back(other);
    });
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    Area area;
    for (const uint32_t other : others_) {
      const Area common = areaUnder(t, other, view);
      if (common.value <= kTolerance * common.noise) continue;
      found_.overlapping.insert(found_.overlapping.end(), {t, other});
      area.add(common);
    }
    return area;
  }

  Area areaUnder(uint32_t t, uint32_t other, const View& view) const {
    Area area;
    const bool sameWay = dot(x_.triangleNormal(t).n, x_.triangleNormal(other).n) > 0;
    for (const uint32_t face : faces_[other]) {
      bool inPlane = true;
      for (const std::span<const uint32_t> loop : x_.cut.loops(face)) {
        Polygon polygon = loopPolygon(loop, view);
        for (int k = 0; k < 3; ++k) {
          const Vec3 &a = view.corners[k], &b = view.corners[(k + 1) % 3];
          clip(polygon, [&](const Vec3& p) { return view.sign * cross(b - a, p - a)[view.axis]; });
        }
        for (const Vec3& p : polygon) inPlane &= distanceToTriangle(p, view.corners[0], view.corners[1], view.corners[2]) <= kTolerance;
        Area part = polygon.empty() ? Area{} : areaOf(polygon, view);
        if (!sameWay) part.value = -part.value;
        if (inPlane) area.add(part);
      }
      if (!inPlane) return {};
    }
    return area;
  }

  const Context& x_;
  const TriangleBins& bins_;
  const FacesOfTriangles& faces_;
  Findings& found_;
  std::vector<uint32_t> others_;
};

}  // namespace

SurfaceChecks checkSurface(const Context& context, const InputTopology& topology, const TriangleBins& bins, detail::Monitor& monitor) {
  const FacesOfTriangles faces = facesOfTriangles(context);
  const auto work = [&](Findings& findings, size_t begin, size_t end) {
    TriangleCheck check(context, bins, faces, findings);
    for (uint32_t t = uint32_t(begin); t < end; ++t) {
      if (!context.dropped[t]) {
        check.checkArea(t);
      } else if (!topology.isDuplicate(t) && context.hasArea(t)) {
        check.checkDropped(t);
      }
    }
  };
  Findings all;
  std::vector<uint8_t> overlapping(context.mesh.triangleCount(), 0);
  for (const Findings& part : detail::forChunks<Findings>(context.mesh.triangleCount(), monitor, work)) {
    all.area.merge(part.area);
    all.droppedTriangles.merge(part.droppedTriangles);
    for (const uint32_t t : part.overlapping) overlapping[t] = 1;
  }
  return {all.area.finish(), all.droppedTriangles.finish(), std::move(overlapping)};
}

}  // namespace mandoline::validation
