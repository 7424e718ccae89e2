#include "cut/stages/separate.h"

#include <cmath>
#include <numeric>

#include "base/group_numbers.h"
#include "base/position_table.h"
#include "base/prefetch.h"

namespace mandoline::detail {
namespace {

class Separator {
 public:
  Separator(const KeptVertices& kept, bool doTrianglesMeet, CutMesh& out) : kept_(kept), maskInCell_(doTrianglesMeet ? 7 : 0), out_(out) {
    const auto hasFewer = [](const auto& a, const auto& b) { return a.size() < b.size(); };
    axis_ = size_t(std::max_element(out.grid.planes.begin(), out.grid.planes.end(), hasFewer) - out.grid.planes.begin());
    while (slabCount() >> shift_ > out.vertexCount() / kVertices + 1) ++shift_;
  }

  void run(Monitor& monitor) {
    const size_t count = (slabCount() >> shift_) + 1;
    const auto layers = kept_.runs.empty()
                            ? groupNumbers(count, out_.vertexCount(), monitor, [&](size_t v) { return layerOf(uint32_t(v)); })
                            : groupOthers(count, monitor);
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    runItems(order, monitor, [&](size_t, uint32_t layer) { separate(layers[layer]); });
  }

 private:
  static constexpr size_t kVertices = 4096;  // about as many as a layer has, at least
  static constexpr size_t kAhead = 16;       // vertices of a layer, whose positions are all over memory

  /// Groups vertices that are not kept.
  Csr<uint32_t> groupOthers(size_t count, Monitor& monitor) const {
    std::vector<uint32_t> others;
    kept_.forOthers(0, out_.vertexCount(), [&](size_t first, size_t past) {
      for (size_t v = first; v < past; ++v) others.push_back(uint32_t(v));
    });
    auto layers = groupNumbers(count, others.size(), monitor, [&](size_t i) { return layerOf(others[i]); });
    for (uint32_t& item : layers.items) item = others[item];
    return layers;
  }

  /// Vertices on different grid elements never have the same position: see CutVertices::position. At a grid vertex there is one; inside of
  /// a grid cell there are those of the mesh alone, unless triangles meet. None of these has a layer; a layer has all others of the grid
  /// elements that it has.
  uint32_t layerOf(uint32_t v) const {
    const uint8_t mask = out_.vertexMask[v];
    if (mask == 7 || mask == maskInCell_) return kNoGroup;
    return uint32_t((2 * size_t(out_.vertexCell[3 * size_t(v) + axis_]) + !(mask >> axis_ & 1)) >> shift_);
  }
  size_t slabCount() const { return 2 * out_.grid.planes[axis_].size(); }

  void separate(std::span<const uint32_t> layer) {
    PositionTable table(layer.size(), [&](uint32_t v) { return &out_.positions[3 * size_t(v)]; });
    for (size_t i = 0; i < layer.size(); ++i) {
      if (i + kAhead < layer.size()) prefetch(&out_.positions[3 * size_t(layer[i + kAhead])]);
      const uint32_t v = layer[i];
      double* p = &out_.positions[3 * size_t(v)];
      uint32_t* slot = &table.find(p);
      const Point original = {p[0], p[1], p[2]};
      for (int steps = 1; *slot != table.kFree && steps < 64; ++steps) {
        for (int way = 0; way < 6 && *slot != table.kFree; ++way) {
          const int d = way >> 1, c = out_.vertexCell[3 * size_t(v) + d];
          if (out_.vertexMask[v] >> d & 1 || out_.vertexTriVertex[v] >= 0) continue;
          const double toward = out_.grid.planes[d][size_t(c) + (way & 1)];
          double x = original[d];
          for (int k = 0; k < steps; ++k) x = std::nextafter(x, toward);
          if (x == toward) continue;
          std::copy(original.begin(), original.end(), p);
          p[d] = x;
          slot = &table.find(p);
        }
      }
      if (*slot == table.kFree) *slot = v;
    }
  }

  const KeptVertices& kept_;
  const uint8_t maskInCell_;  // those of vertices inside of grid cells, if these never meet
  CutMesh& out_;
  size_t axis_;
  int shift_ = 0;
};

}  // namespace

void separate(const KeptVertices& kept, bool doTrianglesMeet, CutMesh& out, Monitor& monitor) {
  Separator(kept, doTrianglesMeet, out).run(monitor);
}

}  // namespace mandoline::detail
