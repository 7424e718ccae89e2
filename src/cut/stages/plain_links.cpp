#include "cut/stages/plain_links.h"

namespace mandoline::detail {
namespace {

/// The half-faces of a tri-cut-face towards smaller and larger angles about its edge, from the lower vertex to the higher.
LocalHalf before(LocalFace face, bool ascending) { return sideOf(face, ascending ? 0 : 1); }
LocalHalf after(LocalFace face, bool ascending) { return sideOf(face, ascending ? 1 : 0); }

/// The edges on one side of a grid-face, in the direction of their axis, and the half-face beside each.
class Side {
 public:
  /// `side`: as of an Outline, where edges 2 and 3 run against their axis. `first`: of the grid-face's half-faces.
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
  joins_.clear();
  if (!findHalves(cell) || !linkTriEdges(cell) || !linkHybridEdges(cell)) return false;
  linkGridEdges(cell);
  for (const auto& [a, b] : joins_) shells.unite(a, b);
  return true;
}

/// False if a grid-face needed a planar graph.
bool PlainLinks::findHalves(const CellView& cell) {
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  LocalHalf next = *cell.halves.gridHalves().begin();
  for (size_t i = 0; i < 6; ++i) {
    if (cell.faces.grid.kinds[gridFaces[i]] == GridFaceKind::graph) return false;
    first_[i] = next;
    next.number += uint32_t(cell.faces.grid.halfFaces[gridFaces[i]].size());
  }
  return true;
}

/// Edges inside of the cell have two tri-cut-faces. False if an edge has more, or lies on a grid line, or if a face has holes.
bool PlainLinks::linkTriEdges(const CellView& cell) {
  const CutVertices& vertices = cell.surface.vertices;
  const TriFaces& tri = cell.faces.tri;
  size_t most = 0;
  for (const FaceId f : cell.halves.triFaces) most += tri.loopsOf(f)[0].size();
  const StampedTable::View table = table_.clear(2 * most);
  uses_.clear();
  for (const LocalFace f : cell.halves.localFaces()) {
    const FaceId id = cell.halves.triFace(f);
    const auto loops = tri.loopsOf(id);
    if (loops.size() > 1) return false;
    const auto loop = loops[0];
    for (size_t k = 0; k < loop.size(); ++k) {
      const VertexId u = loop[k], v = loop[k + 1 < loop.size() ? k + 1 : 0];
      const Use use = {f, u < v, false};
      const uint64_t key = keyOf(u, v);
      StampedTable::Slot& slot = table.at(key);
      if (table.isFree(slot)) {
        table.put(slot, key, uint32_t(uses_.size()));
        uses_.push_back(use);
        continue;
      }
      Use& other = uses_[slot.number];
      if (other.isLinked || other.face == f || (tri.touchesLine[id] && liesInPlane(vertices.slab(u), vertices.slab(v)))) return false;
      other.isLinked = true;
      join(after(other.face, other.ascending), before(f, use.ascending));
      join(after(f, use.ascending), before(other.face, other.ascending));
    }
  }
  return true;
}

/// All others lie in grid-faces and have one tri-cut-face in the cell, and a piece on either side. Seen from below the plane, the piece
/// that runs upwards along the edge is the left one of its direction.
bool PlainLinks::linkHybridEdges(const CellView& cell) {
  const StampedTable::View table = table_.view();
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  for (size_t i = 0; i < 6; ++i) {
    const GridFaceId g = gridFaces[i];
    if (cell.faces.grid.kinds[g] == GridFaceKind::whole) continue;
    const auto edges = cell.stencil.edgesOnFace[g];
    const auto beside = cell.faces.grid.beside[g];
    const auto sides = beside.subspan(5 + beside[4]);
    for (size_t e = 0; e < edges.size(); ++e) {
      const StampedTable::Slot& slot = table.at(keyOf(edges[e].from, edges[e].to));
      if (table.isFree(slot) || uses_[slot.number].isLinked) return false;
      Use& use = uses_[slot.number];
      use.isLinked = true;
      const bool isBelow = i & 1, isLeft = (edges[e].from < edges[e].to) == isBelow;
      const LocalHalf up{first_[i].number + sides[2 * e + !isLeft]}, down{first_[i].number + sides[2 * e + isLeft]};
      join(down, before(use.face, use.ascending));
      join(after(use.face, use.ascending), up);
    }
  }
  bool areAllLinked = true;
  for (const Use& use : uses_) areAllLinked &= use.isLinked;
  return areAllLinked;
}

/// Grid-faces meet along the grid-edges of the cell, cut-edge by cut-edge.
void PlainLinks::linkGridEdges(const CellView& cell) {
  const auto& gridFaces = cell.stencil.cells[cell.halves.gridCell].faces;
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < 4; ++i) {
      const int side1 = i & 1, side2 = i >> 1;  // of the grid-edge, along d + 1 and d + 2
      const size_t p = size_t(cellFace((d + 1) % 3, side1)), q = size_t(cellFace((d + 2) % 3, side2));
      const Side a(cell.faces.grid, gridFaces[p], side2 == 1 ? 1 : 3, first_[p]),
          b(cell.faces.grid, gridFaces[q], side1 == 0 ? 0 : 2, first_[q]);
      const size_t size = std::max<size_t>({a.size, b.size, 1});
      for (size_t e = 0; e < size; ++e) join(a.half(e), b.half(e));
    }
  }
}

}  // namespace mandoline::detail
