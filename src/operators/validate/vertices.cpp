// Cut-vertices: their cells and masks against their positions and the planes, tri-vertices against the input.
#include <algorithm>

#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

struct Tallies {
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
  VertexCheck(const Context& context, const std::vector<uint32_t>& named, Tallies& tallies)
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

  void checkParents(uint32_t v) {
    const int32_t a = x_.cut.vertexParents[2 * size_t(v)], b = x_.cut.vertexParents[2 * size_t(v) + 1], t = x_.cut.vertexTriVertex[v];
    if ((t >= 0) != (a >= 0 && a == b) || (t >= 0 && a != t))
      return vertices_.violate("vertex", v, "has parents that do not fit its tri-vertex");
    if (t >= 0) return;
    const int planes = x_.onPlane(v, 0) + x_.onPlane(v, 1) + x_.onPlane(v, 2);
    if (planes < (a < 0 ? 3 : b < 0 ? 2 : 1)) return vertices_.violate("vertex", v, "is on too few planes for its parents");
    const Vec3 p = x_.vertex(v);
    const auto local = [&](const Vec3& q) { return x_.inRoundings(q, p); };
    if (b >= 0) {
      const double distance = distanceToSegment({}, local(x_.triVertex(uint32_t(a))), local(x_.triVertex(uint32_t(b))));
      positions_.measure(Deviation::ofDistance(distance), "vertex", v, "is off its tri-edge by {} of the largest coordinate");
    } else if (a >= 0) {
      const size_t triangle = size_t(a);
      const double distance =
          distanceToTriangle({}, local(x_.corner(triangle, 0)), local(x_.corner(triangle, 1)), local(x_.corner(triangle, 2)));
      positions_.measure(Deviation::ofDistance(distance), "vertex", v, "is off its triangle by {} of the largest coordinate");
    }
  }

  const Context& x_;
  const std::vector<uint32_t>& named_;
  Tally &vertices_, &positions_;
};

void checkGridVerticesDiffer(const Context& context, Tally& tally) {
  std::vector<uint32_t> onGrid;
  for (uint32_t v = 0; v < context.cut.vertexCount(); ++v) {
    if (context.cut.vertexMask[v] == 7) onGrid.push_back(v);
  }
  const auto place = [&](uint32_t v) {
    const int32_t* cell = context.cellAt(v);
    return std::array<int32_t, 3>{cell[0], cell[1], cell[2]};
  };
  std::sort(onGrid.begin(), onGrid.end(), [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  for (size_t i = 1; i < onGrid.size(); ++i) {
    if (place(onGrid[i - 1]) == place(onGrid[i])) tally.violate("vertex", onGrid[i], "is the same grid vertex as another");
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
  Tallies all;
  const auto parts = detail::forChunks<Tallies>(context.cut.vertexCount(), monitor, [&](Tallies& tallies, size_t begin, size_t end) {
    VertexCheck check(context, named, tallies);
    for (size_t v = begin; v < end; ++v) check.run(uint32_t(v));
  });
  for (const Tallies& part : parts) {
    all.vertices.merge(part.vertices);
    all.positions.merge(part.positions);
  }
  checkGridVerticesDiffer(context, all.vertices);
  checkInputIsThere(context, named, all.vertices);
  return {all.vertices.finish(), all.positions.finish()};
}

}  // namespace mandoline::validation
