#include "cut/stages/plain_links.h"

namespace mandoline::detail {
namespace {

uint64_t keyOf(VertexId u, VertexId v) { return uint64_t(std::min(u, v).number) << 32 | std::max(u, v).number; }

/// The half-faces of a tri-cut-face towards smaller and larger angles about its edge, from the lower vertex to the higher.
LocalHalf before(LocalFace face, bool ascending) { return sideOf(face, ascending ? 0 : 1); }
LocalHalf after(LocalFace face, bool ascending) { return sideOf(face, ascending ? 1 : 0); }

/// The edges on one side of a grid-face, in the direction of their axis, and the half-face beside each.
class Side {
 public:
  /// `side`: as of Stencil::edgesOf(), where edges 2 and 3 run against their axis. `first`: of the grid-face's half-faces.
  Side(const GridFaces& faces, GridFaceId gridFace, size_t side, LocalHalf first) : first_(first) {
    if (faces.kinds[gridFace] == GridFaceKind::whole) return;
    const auto beside = faces.beside[gridFace];
    size = beside[side + 1] - beside[side];
    pieces_ = &beside[5 + (side < 2 ? beside[side] : beside[side + 1] - 1)];
    step_ = side < 2 ? 1 : -1;
  }

  size_t size = 0;  ///< 0 if one half-face is beside all of them
  LocalHalf half(size_t edge) const { return size == 0 ? first_ : LocalHalf{first_.number + pieces_[ptrdiff_t(edge) * step_]}; }

 private:
  LocalHalf first_;
  const uint32_t* pieces_ = nullptr;
  ptrdiff_t step_ = 0;
};

bool liesInPlane(const Slab& a, const Slab& b) {
  bool lies = false;
  for (size_t d = 0; d < 3; ++d) lies |= onPlane(a[d]) && a[d] == b[d];
  return lies;
}

}  // namespace

bool PlainLinks::link(const CellView& cell, Shells& shells) {
  pairs_.clear();
  if (!collectUses(cell) || !linkHybridEdges(cell) || !linkTriEdges(cell)) return false;
  for (const auto& [a, b] : pairs_) shells.unite(a, b);
  linkGridEdges(cell, shells);
  return true;
}

/// The one use of an edge, from a place on, if there is just one.
std::optional<size_t> PlainLinks::findOnly(uint64_t key, size_t from) const {
  size_t found = 0, count = 0;
  for (size_t i = from; i < count_; ++i) {  // without branches, which nothing would predict
    const bool is = keys_[i] == key;
    found = is ? i : found;
    count += is;
  }
  if (count != 1) return {};
  return found;
}

/// False if a grid-face needed a planar graph, a tri-cut-face has holes, or there are too many for a search among all.
bool PlainLinks::collectUses(const CellView& cell) {
  if (cell.halves.triFaces.size() > kMostFaces) return false;
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  LocalHalf next = *cell.halves.gridHalves().begin();
  for (size_t i = 0; i < 6; ++i) {
    if (cell.faces.grid.kinds[gridFaces[i]] == GridFaceKind::graph) return false;
    first_[i] = next;
    next.number += uint32_t(cell.faces.grid.halfFaces[gridFaces[i]].size());
  }
  count_ = 0;
  for (const LocalFace f : cell.halves.localFaces()) {
    const auto loops = cell.faces.tri.loopsOf(cell.halves.triFace(f));
    const auto loop = loops[0];
    if (loops.size() > 1 || count_ + loop.size() > kMostUses) return false;
    for (size_t k = 0; k < loop.size(); ++k) {
      const VertexId u = loop[k], v = loop[k + 1 < loop.size() ? k + 1 : 0];
      keys_[count_] = keyOf(u, v);
      uses_[count_++] = {f, u < v, false};
    }
  }
  return true;
}

/// Each edge in a grid-face has one tri-cut-face in the cell, and a piece on either side. Seen from below the plane, the piece that runs
/// upwards along the edge is the left one of its direction.
bool PlainLinks::linkHybridEdges(const CellView& cell) {
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  for (size_t i = 0; i < 6; ++i) {
    const GridFaceId g = gridFaces[i];
    if (cell.faces.grid.kinds[g] == GridFaceKind::whole) continue;
    const auto edges = cell.stencil.edgesOnFace[g];
    const auto beside = cell.faces.grid.beside[g];
    const auto sides = beside.subspan(5 + beside[4]);
    for (size_t e = 0; e < edges.size(); ++e) {
      const auto found = findOnly(keyOf(edges[e].from, edges[e].to), 0);
      if (!found || uses_[*found].isLinked) return false;
      Use& use = uses_[*found];
      use.isLinked = true;
      const bool isBelow = i & 1, isLeft = (edges[e].from < edges[e].to) == isBelow;
      const LocalHalf up{first_[i].number + sides[2 * e + !isLeft]}, down{first_[i].number + sides[2 * e + isLeft]};
      pairs_.push_back({down, before(use.face, use.ascending)});
      pairs_.push_back({after(use.face, use.ascending), up});
    }
  }
  return true;
}

/// All other edges have two tri-cut-faces, and lie inside of the cell.
bool PlainLinks::linkTriEdges(const CellView& cell) {
  const auto& slabs = cell.surface.vertices.slabs;
  for (size_t a = 0; a < count_; ++a) {
    const Use& use = uses_[a];
    if (use.isLinked) continue;
    const auto found = findOnly(keys_[a], a + 1);
    if (!found || uses_[*found].isLinked || uses_[*found].face == use.face) return false;
    if (liesInPlane(slabs[{uint32_t(keys_[a] >> 32)}], slabs[{uint32_t(keys_[a])}])) return false;
    Use* const other = &uses_[*found];
    other->isLinked = true;
    pairs_.push_back({after(other->face, other->ascending), before(use.face, use.ascending)});
    pairs_.push_back({after(use.face, use.ascending), before(other->face, other->ascending)});
  }
  return true;
}

/// Grid-faces meet along the grid-edges of the cell, cut-edge by cut-edge.
void PlainLinks::linkGridEdges(const CellView& cell, Shells& shells) const {
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < 4; ++i) {
      const int side1 = i & 1, side2 = i >> 1;  // of the grid-edge, along d + 1 and d + 2
      const size_t p = size_t(cellFace((d + 1) % 3, side1)), q = size_t(cellFace((d + 2) % 3, side2));
      const Side a(cell.faces.grid, gridFaces[p], side2 == 1 ? 1 : 3, first_[p]),
          b(cell.faces.grid, gridFaces[q], side1 == 0 ? 0 : 2, first_[q]);
      const size_t size = std::max<size_t>({a.size, b.size, 1});
      for (size_t e = 0; e < size; ++e) shells.unite(a.half(e), b.half(e));
    }
  }
}

}  // namespace mandoline::detail
