// Cut-vertices (paper, 3.2): their cells and masks against their positions and the planes, tri-vertices against the input.
#include <algorithm>

#include "operators/validate/context.h"

namespace mandoline::validation {
namespace {

class VertexCheck {
 public:
  explicit VertexCheck(const Context& context) : x_(context), present_(context.mesh.vertexCount(), 0) {}

  void run(std::vector<Check>& checks) {
    for (uint32_t v = 0; v < x_.cut.vertexCount(); ++v) {
      if (x_.cut.vertexTriVertex[v] >= 0) checkTriVertex(v);
      checkPlanes(v);
      checkParents(v);
    }
    checkGridVerticesDiffer();
    checkInputIsThere();
    checks.push_back(vertices_.finish());
    checks.push_back(positions_.finish());
  }

 private:
  void checkTriVertex(uint32_t v) {
    const uint32_t t = uint32_t(x_.cut.vertexTriVertex[v]);
    if (x_.weld[t] != t) return vertices_.violate("vertex", v, "does not name the lowest tri-vertex at its position");
    if (present_[t]) return vertices_.violate("vertex", v, "names a tri-vertex that another one names");
    present_[t] = 1;
    const Vec3 p = x_.vertex(v), input = x_.triVertex(t);
    for (int d = 0; d < 3; ++d) {
      if (p[d] != input[d]) return vertices_.violate("vertex", v, "is not at its tri-vertex's position");
      const int32_t c = x_.cellAt(v)[d];
      const bool fits = x_.onPlane(v, d) ? input[d] == x_.planes[d][c] : input[d] > x_.planes[d][c] && input[d] < x_.planes[d][c + 1];
      if (!fits) return vertices_.violate("vertex", v, "is a tri-vertex in another slab than its cell and mask say");
    }
  }

  void checkPlanes(uint32_t v) {
    for (int d = 0; d < 3; ++d) {
      const double p = x_.vertex(v)[d];
      const int32_t c = x_.cellAt(v)[d];
      const double low = x_.planes[d][c], high = x_.onPlane(v, d) ? low : x_.planes[d][c + 1];
      positions_.measure(std::max(low - p, p - high) / x_.rounding[d], "vertex", v,
                         "lies outside of the slab or off the plane that its cell and mask name");
    }
  }

  void checkParents(uint32_t v) {
    const int32_t a = x_.cut.vertexParents[2 * size_t(v)], b = x_.cut.vertexParents[2 * size_t(v) + 1], t = x_.cut.vertexTriVertex[v];
    const Vec3 p = x_.vertex(v);
    const auto local = [&](const Vec3& q) { return x_.inRoundings(q, p); };
    if ((t >= 0) != (a >= 0 && a == b) || (t >= 0 && a != t))
      return vertices_.violate("vertex", v, "has parents that do not fit its tri-vertex");
    if (t >= 0) return;
    const int planes = x_.onPlane(v, 0) + x_.onPlane(v, 1) + x_.onPlane(v, 2);
    if (planes < (a < 0 ? 3 : b < 0 ? 2 : 1)) return vertices_.violate("vertex", v, "is on too few planes for its parents");
    if (a < 0) return;
    if (b >= 0) {
      positions_.measure(distanceToSegment({}, local(x_.triVertex(uint32_t(a))), local(x_.triVertex(uint32_t(b)))), "vertex", v,
                         "is off its tri-edge");
    } else {
      positions_.measure(distanceToTriangle({}, local(x_.corner(a, 0)), local(x_.corner(a, 1)), local(x_.corner(a, 2))), "vertex", v,
                         "is off its triangle");
    }
  }

  void checkGridVerticesDiffer() {
    std::vector<uint32_t> onGrid;
    for (uint32_t v = 0; v < x_.cut.vertexCount(); ++v) {
      if (x_.cut.vertexMask[v] == 7) onGrid.push_back(v);
    }
    const auto place = [&](uint32_t v) { return std::array<int32_t, 3>{x_.cellAt(v)[0], x_.cellAt(v)[1], x_.cellAt(v)[2]}; };
    std::sort(onGrid.begin(), onGrid.end(), [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
    for (size_t i = 1; i < onGrid.size(); ++i) {
      if (place(onGrid[i - 1]) == place(onGrid[i])) vertices_.violate("vertex", onGrid[i], "is the same grid vertex as another");
    }
  }

  void checkInputIsThere() {
    for (size_t t = 0; t < x_.mesh.triangleCount(); ++t) {
      for (int i = 0; i < 3 && !x_.dropped[t]; ++i) {
        const uint32_t v = x_.weld[x_.mesh.triangles[3 * t + i]];
        if (present_[v] || !x_.inBox(x_.triVertex(v))) continue;
        vertices_.violate("tri-vertex", v, "lies in the box and on a triangle that is not dropped, but is no vertex");
        present_[v] = 1;
      }
    }
  }

  const Context& x_;
  std::vector<uint8_t> present_;  // per tri-vertex
  Tally vertices_{"vertices"};
  Tally positions_{"positions", kTolerance};
};

}  // namespace

void checkVertices(const Context& context, std::vector<Check>& checks) { VertexCheck(context).run(checks); }

}  // namespace mandoline::validation
