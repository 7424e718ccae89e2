// Cut-vertices: their cells and masks against their positions and the planes, tri-vertices against the input.
#include <algorithm>

#include "base/csr.h"
#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

struct VertexTallies {
  Tally vertices{"vertices"}, positions{"positions", kTolerance};
};

/// Per tri-vertex: the first vertex that names it, or kNone.
constexpr uint32_t kNone = UINT32_MAX;
std::vector<uint32_t> namedBy(const Context& context) {
  std::vector<uint32_t> named(context.mesh.vertexCount(), kNone);
  for (uint32_t v = 0; v < context.cut.vertexCount(); ++v) {
    const int32_t t = context.cut.vertexTriVertex[v];
    if (t >= 0 && named[t] == kNone) named[t] = v;
  }
  return named;
}

/// One vertex by itself.
class VertexCheck {
 public:
  VertexCheck(const Context& context, const std::vector<uint32_t>& named, VertexTallies& tallies)
      : x_(context), named_(named), vertices_(tallies.vertices), positions_(tallies.positions) {}

  void run(uint32_t v) {
    if (x_.cut.vertexTriVertex[v] >= 0) checkTriVertex(v);
    checkPlanes(v);
    checkParents(v);
  }

 private:
  void checkTriVertex(uint32_t v) {
    const uint32_t t = uint32_t(x_.cut.vertexTriVertex[v]);
    if (x_.weld[t] != t) return vertices_.violate("vertex", v, "does not name the lowest tri-vertex at its position");
    if (named_[t] != v) return vertices_.violate("vertex", v, "names a tri-vertex that another one names");
    const Vec3 p = x_.vertex(v), input = x_.triVertex(t);
    for (int d = 0; d < 3; ++d) {
      if (p[d] != input[d]) return vertices_.violate("vertex", v, "is not at its tri-vertex's position");
      const auto& planes = x_.planes()[size_t(d)];
      const size_t c = size_t(x_.cellAt(v)[d]);
      const bool fits = x_.onPlane(v, d) ? input[d] == planes[c] : input[d] > planes[c] && input[d] < planes[c + 1];
      if (!fits) return vertices_.violate("vertex", v, "is a tri-vertex in another slab than its cell and mask say");
    }
  }

  void checkPlanes(uint32_t v) {
    for (int d = 0; d < 3; ++d) {
      const double p = x_.vertex(v)[d];
      const auto& planes = x_.planes()[size_t(d)];
      const size_t c = size_t(x_.cellAt(v)[d]);
      const double low = planes[c], high = x_.onPlane(v, d) ? low : planes[c + 1];
      positions_.measure(Deviation::ofDistance(std::max(low - p, p - high) / x_.rounding[d]), "vertex", v,
                         "is outside the slab or off the plane that its cell and mask name, by {} of the largest coordinate");
    }
  }

  /// Exact: the planes of its mask hold it, and those beside its cell do not.
  void checkMask(uint32_t v) {
    if (!x_.exact.isKnown(v)) return vertices_.violate("vertex", v, "has parents that do not meet in one point");
    for (int d = 0; d < 3; ++d) {
      const size_t c = size_t(x_.cellAt(v)[d]);
      const Residue p = x_.exact[v][size_t(d)];
      const auto isOn = [&](size_t plane) { return p == x_.exact.axialPlane(d, plane); };
      const bool fits = x_.onPlane(v, d) ? isOn(c) : !isOn(c) && !isOn(c + 1);
      if (!fits) return vertices_.violate("vertex", v, "is on other planes than its mask says");
    }
  }

  void checkParents(uint32_t v) {
    const int32_t a = x_.cut.vertexParents[2 * size_t(v)], b = x_.cut.vertexParents[2 * size_t(v) + 1], t = x_.cut.vertexTriVertex[v];
    if ((t >= 0) != (a >= 0 && a == b) || (t >= 0 && a != t))
      return vertices_.violate("vertex", v, "has parents that do not fit its tri-vertex");
    if (t >= 0) return;
    const int64_t made = a < 0 ? x_.madeIndex(v) : -1;
    const int planes = x_.onPlane(v, 0) + x_.onPlane(v, 1) + x_.onPlane(v, 2);
    if (made < 0 && planes < (a < 0 ? 3 : b < 0 ? 2 : 1)) return vertices_.violate("vertex", v, "is on too few planes for its parents");
    checkMask(v);
    if (made >= 0) {
      checkMadeParents(v, size_t(made));
    } else if (b >= 0) {
      checkOnEdge(v, uint32_t(a), uint32_t(b));
    } else if (a >= 0) {
      checkInTriangle(v, size_t(a));
    }
  }

  void checkMadeParents(uint32_t v, size_t made) {
    const int32_t* parents = &x_.cut.madeVertexParents[4 * made];
    const MadeVertex kind = MadeVertex(x_.cut.madeVertexKinds[made]);
    const int triVertices = kind == MadeVertex::edgeTriangle ? 2 : kind == MadeVertex::edgeEdge ? 4 : 0;
    for (int i = 0; i < triVertices; i += 2) checkOnEdge(v, uint32_t(parents[i]), uint32_t(parents[i + 1]));
    for (int i = triVertices; i < 4 && parents[i] >= 0; ++i) checkInTriangle(v, size_t(parents[i]));
  }

  void checkOnEdge(uint32_t v, uint32_t a, uint32_t b) {
    const Vec3 p = x_.vertex(v), start = x_.triVertex(a), end = x_.triVertex(b);
    const double distance = distanceToSegment({}, x_.inRoundings(start, p), x_.inRoundings(end, p));
    positions_.measure(Deviation::ofDistance(distance), "vertex", v, "is off its tri-edge by {} of the largest coordinate");
    if (x_.exact.isKnown(v) && !collinear(x_.exact[v], x_.exact.triVertex(a), x_.exact.triVertex(b)))
      vertices_.violate("vertex", v, "does not lie on its tri-edge");
  }

  void checkInTriangle(uint32_t v, size_t triangle) {
    const Vec3 p = x_.vertex(v);
    const auto corner = [&](int i) { return x_.inRoundings(x_.corner(triangle, i), p); };
    const double distance = distanceToTriangle({}, corner(0), corner(1), corner(2));
    positions_.measure(Deviation::ofDistance(distance), "vertex", v, "is off its triangle by {} of the largest coordinate");
    if (!x_.inPlane(v, triangle)) vertices_.violate("vertex", v, "does not lie in the plane of its triangle");
  }

  const Context& x_;
  const std::vector<uint32_t>& named_;
  Tally &vertices_, &positions_;
};

/// Each point is one vertex.
void checkDistinct(const Context& context, Tally& tally) {
  std::vector<detail::KeyedItem> byPlace;
  for (uint32_t v = 0; v < context.cut.vertexCount(); ++v) {
    if (!context.exact.isKnown(v)) continue;
    uint64_t hash = 0;
    for (const Residue& x : context.exact[v]) hash = Random::mix(hash + 0x9e3779b97f4a7c15u + x.bits());
    byPlace.push_back({hash, v});
  }
  detail::sortByKey(byPlace, ~uint64_t(0));
  for (size_t i = 1; i < byPlace.size(); ++i) {
    if (byPlace[i - 1].key == byPlace[i].key) tally.violate("vertex", byPlace[i].item, "is the same point as another");
  }
}

void checkInputIsThere(const Context& context, const std::vector<uint32_t>& named, Tally& tally) {
  std::vector<uint8_t> reported(named.size(), 0);
  for (size_t t = 0; t < context.mesh.triangleCount(); ++t) {
    for (size_t i = 0; i < 3 && !context.dropped[t]; ++i) {
      const uint32_t v = context.weld[context.mesh.triangles[3 * t + i]];
      if (named[v] != kNone || reported[v] || !context.inBox(context.triVertex(v))) continue;
      tally.violate("tri-vertex", v, "lies in the box and on a triangle that is not dropped, but is no vertex");
      reported[v] = 1;
    }
  }
}

}  // namespace

VertexChecks checkVertices(const Context& context, detail::Monitor& monitor) {
  const std::vector<uint32_t> named = namedBy(context);
  VertexTallies all;
  const auto parts =
      detail::forChunks<VertexTallies>(context.cut.vertexCount(), monitor, [&](VertexTallies& tallies, size_t begin, size_t end) {
        VertexCheck check(context, named, tallies);
        for (size_t v = begin; v < end; ++v) check.run(uint32_t(v));
      });
  for (const VertexTallies& part : parts) {
    all.vertices.merge(part.vertices);
    all.positions.merge(part.positions);
  }
  checkDistinct(context, all.vertices);
  checkInputIsThere(context, named, all.vertices);
  return {all.vertices.finish(), all.positions.finish()};
}

}  // namespace mandoline::validation
