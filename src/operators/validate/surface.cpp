// The surface is all there: area of each triangle's faces (paper, 5.6), reasons of dropped triangles.
#include <algorithm>

#include "operators/validate/bins.h"

namespace mandoline::validation {
namespace {

class SurfaceCheck {
 public:
  SurfaceCheck(const Context& context, const TriangleBins& bins, std::vector<uint8_t>& overlapping)
      : x_(context),
        bins_(bins),
        overlapping_(overlapping),
        faceOffsets_(context.mesh.triangleCount() + 2, 0),
        seenBy_(context.mesh.triangleCount(), UINT32_MAX) {
    overlapping_.assign(x_.mesh.triangleCount(), 0);
    // Counted two places on, so that filling leaves begins one place on.
    for (const int32_t t : x_.cut.faceTriangle) {
      if (t >= 0) ++faceOffsets_[size_t(t) + 2];
    }
    for (size_t t = 2; t < faceOffsets_.size(); ++t) faceOffsets_[t] += faceOffsets_[t - 1];
    faces_.resize(faceOffsets_.back());
    for (uint32_t f = 0; f < x_.cut.faceCount(); ++f) {
      const int32_t t = x_.cut.faceTriangle[f];
      if (t >= 0) faces_[faceOffsets_[size_t(t) + 1]++] = f;
    }
  }

  void run(std::vector<Check>& checks) {
    for (uint32_t t = 0; t < x_.mesh.triangleCount(); ++t) {
      if (x_.dropped[t]) {
        checkDropped(t);
      } else {
        checkArea(t);
      }
    }
    for (Tally* tally : {&area_, &droppedTriangles_}) checks.push_back(tally->finish());
  }

 private:
  /// A triangle seen along the dominant axis of its normal, in roundings relative to its first corner.
  struct View {
    Vec3 origin, corners[3];
    int axis, sign;
  };
  /// An area, and what a move of its boundary by one rounding changes of it.
  struct Area {
    double value = 0, noise = 0;
    void add(const Area& other) { value += other.value, noise += other.noise; }
  };
  View look(uint32_t t) const {
    View view;
    view.origin = x_.corner(t, 0);
    for (int i = 0; i < 3; ++i) view.corners[i] = x_.inRoundings(x_.corner(t, i), view.origin);
    view.axis = dominantAxis(cross(view.corners[1], view.corners[2]));
    view.sign = turn(x_.corner(t, 0), x_.corner(t, 1), x_.corner(t, 2), view.axis);
    return view;
  }

  static Area areaOf(const Polygon& polygon, const View& view) {
    const int e = (view.axis + 1) % 3, f = (view.axis + 2) % 3;
    Area area;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      area.value += view.sign * cross(a - polygon[0], b - polygon[0])[view.axis] / 2;
      area.noise += std::fabs(b[e] - a[e]) + std::fabs(b[f] - a[f]) + 1;
    }
    return area;
  }

  Area areaInBox(uint32_t t, const View& view) const {
    Polygon polygon(view.corners, view.corners + 3);
    Vec3 low, high;
    for (int d = 0; d < 3; ++d) low[d] = x_.planes[d].front(), high[d] = x_.planes[d].back();
    if (!(x_.inBox(x_.corner(t, 0)) && x_.inBox(x_.corner(t, 1)) && x_.inBox(x_.corner(t, 2)))) {
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
    for (uint32_t i = faceOffsets_[t]; i < faceOffsets_[t + 1]; ++i) {
      x_.forLoops(faces_[i], [&](std::span<const uint32_t> loop) { area.add(areaOf(loopPolygon(loop, view), view)); });
    }
    return area;
  }

  /// Area of t under faces of other triangles in its plane.
  Area areaUnderOthers(uint32_t t, const View& view) {
    Area area;
    Vec3 low = x_.corner(t, 0), high = low;
    for (int i = 1; i < 3; ++i) {
      for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x_.corner(t, i)[d]), high[d] = std::max(high[d], x_.corner(t, i)[d]);
    }
    bins_.forTriangles(low, high, [&](uint32_t other) {
      if (other == t || x_.dropped[other] || seenBy_[other] == t) return;
      seenBy_[other] = t;
      const Area common = areaUnder(t, other, view);
      if (common.value <= kTolerance * common.noise) return;
      overlapping_[t] = overlapping_[other] = 1;
      area.add(common);
    });
    return area;
  }
  Area areaUnder(uint32_t t, uint32_t other, const View& view) const {
    Area area;
    const bool sameWay = dot(x_.triangleNormal(t).n, x_.triangleNormal(other).n) > 0;
    for (uint32_t i = faceOffsets_[other]; i < faceOffsets_[other + 1]; ++i) {
      bool inPlane = true;
      x_.forLoops(faces_[i], [&](std::span<const uint32_t> loop) {
        Polygon polygon = loopPolygon(loop, view);
        for (int k = 0; k < 3; ++k) {
          const Vec3 &a = view.corners[k], &b = view.corners[(k + 1) % 3];
          clip(polygon, [&](const Vec3& p) { return view.sign * cross(b - a, p - a)[view.axis]; });
        }
        for (const Vec3& p : polygon) inPlane &= distanceToTriangle(p, view.corners[0], view.corners[1], view.corners[2]) <= kTolerance;
        Area part = polygon.empty() ? Area{} : areaOf(polygon, view);
        if (!sameWay) part.value = -part.value;
        if (inPlane) area.add(part);
      });
      if (!inPlane) return {};
    }
    return area;
  }

  void checkArea(uint32_t t) {
    const View view = look(t);
    const Area expected = areaInBox(t, view);
    Area found = areaOfFaces(t, view);
    const auto deviation = [&] {
      const double difference = std::fabs(found.value - expected.value), noise = found.noise + expected.noise;
      return difference > 0 ? difference / noise : 0;
    };
    if (!(deviation() <= kTolerance)) found.add(areaUnderOthers(t, view));
    area_.measure(deviation(), "triangle", t, "has another area than its faces");
  }

  void checkDropped(uint32_t t) {
    if (x_.isDuplicate(t) || !x_.hasArea(t)) return;
    const View view = look(t);
    const Area expected = areaInBox(t, view);
    const bool inside = x_.inBox(x_.corner(t, 0)) && x_.inBox(x_.corner(t, 1)) && x_.inBox(x_.corner(t, 2));
    if (!inside && expected.value <= kTolerance * expected.noise) return;
    const Area covered = areaUnderOthers(t, view);
    if (covered.value <= 0 || covered.value < expected.value - kTolerance * (expected.noise + covered.noise)) {
      droppedTriangles_.violate("triangle", t, "is dropped without a reason");
    }
  }

  const Context& x_;
  const TriangleBins& bins_;
  std::vector<uint8_t>& overlapping_;
  std::vector<uint32_t> faceOffsets_, faces_;  // per triangle
  std::vector<uint32_t> seenBy_;               // per triangle: the last one that it was compared with
  Tally area_{"surfaceArea", kTolerance}, droppedTriangles_{"droppedTriangles"};
};

}  // namespace

void checkSurface(const Context& context, const TriangleBins& bins, std::vector<Check>& checks, std::vector<uint8_t>& overlapping) {
  SurfaceCheck(context, bins, overlapping).run(checks);
}

}  // namespace mandoline::validation
