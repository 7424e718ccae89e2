#include "cut/stages/shared_vertices.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

class VertexLinks {
 public:
  VertexLinks(const CellView& cell, Shells& shells)
      : vertices_(cell.surface.vertices), faces_(cell.faces), cell_(cell.halves), shells_(shells) {
    collect(*cell.surface.input.mesh);
  }

  void run() {
    sortItems(corners_, [](const Corner& a, const Corner& b) { return a.vertex < b.vertex; });
    for (size_t begin = 0, end = 0; begin < corners_.size(); begin = end) {
      while (end < corners_.size() && corners_[end].vertex == corners_[begin].vertex) ++end;
      const std::span<const Corner> corners(corners_.data() + begin, end - begin);
      if (isForest(corners)) unite(corners);
    }
  }

 private:
  /// Where a half-face passes a vertex.
  struct Corner {
    VertexId vertex, before, after;
    LocalHalf half;  ///< of a tri-cut-face, side 0
  };

  void collect(const Prepared& mesh) {
    const auto add = [&](FaceId face, LocalHalf half) {
      for (const auto loop : faces_.loops(face)) {
        for (size_t i = 0; i < loop.size(); ++i) {
          corners_.push_back({loop[i], loop[i > 0 ? i - 1 : loop.size() - 1], loop[i + 1 < loop.size() ? i + 1 : 0], half});
        }
      }
    };
    for (const LocalFace f : cell_.localFaces()) {
      add(cell_.triFace(f), sideOf(f, 0));
      if (!mesh.hasIntersections()) continue;
      // A vertex that touches the face from outside is on none of its loops: a ring about that vertex.
      for (const uint32_t v : mesh.arrangement->innerVertices[faces_.tri.triangles[cell_.triFace(f)].number]) {
        corners_.push_back({{v}, {v}, {v}, sideOf(f, 0)});
      }
    }
    for (const LocalHalf h : cell_.gridHalves()) add(cell_.halfFaces[h].face(), h);
  }

  bool isTri(const Corner& corner) const { return corner.half.number < 2 * cell_.triFaces.size(); }

  /// Whether the arcs of the tri-cut-faces about a vertex form no ring; a ring may pass the boundary of the grid cell, which is one node.
  bool isForest(std::span<const Corner> corners) {
    edges_.clear();
    for (const Corner& c : corners) edges_.insert(edges_.end(), {c.before, c.after});
    sortItems(edges_);
    nodes_.reset(edges_.size() + 1);
    const auto nodeOf = [&](VertexId v, VertexId to) {
      for (size_t d = 0; d < 3; ++d) {
        if (onPlane(vertices_.slab(v)[d]) && vertices_.slab(v)[d] == vertices_.slab(to)[d] && v != to) return uint32_t(edges_.size());
      }
      return uint32_t(std::lower_bound(edges_.begin(), edges_.end(), to) - edges_.begin());
    };
    for (const Corner& c : corners) {
      if (!isTri(c)) continue;
      const uint32_t from = nodeOf(c.vertex, c.before), to = nodeOf(c.vertex, c.after);
      if (nodes_.find(from) == nodes_.find(to)) return false;
      nodes_.unite(from, to);
    }
    return true;
  }

  void unite(std::span<const Corner> corners) {
    for (const Corner& c : corners) {
      shells_.unite(corners[0].half, c.half);
      if (isTri(c)) shells_.unite(corners[0].half, {c.half.number + 1});
    }
  }

  const CutVertices& vertices_;
  const CutFaces& faces_;
  const CellHalves& cell_;
  Shells& shells_;
  std::vector<Corner> corners_;
  std::vector<VertexId> edges_;  // at the vertex, by their other ends
  DisjointSets nodes_;
};

}  // namespace

void uniteAtVertices(const CellView& cell, Shells& shells) { VertexLinks(cell, shells).run(); }

}  // namespace mandoline::detail
