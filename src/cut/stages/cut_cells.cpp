#include "cut/stages/cut_cells.h"

#include "cut/predicates/radial_order.h"
#include "cut/stages/edge_table.h"
#include "cut/stages/floating_shells.h"

namespace mandoline::detail {
namespace {

struct Chunk {
  CutCells cells;
  Predicates predicates;
  CellHalves halves;
  EdgeTable table;
  DisjointSets shells;
  std::vector<EdgeTable::Use> around;
  std::vector<uint32_t> cellOf, counts;
};

class CellMaker {
 public:
  CellMaker(const Surface& surface, const Stencil& stencil, const CutFaces& faces, Chunk& chunk)
      : surface_(surface), vertices_(surface.vertices), stencil_(stencil), faces_(faces), chunk_(chunk) {}

  void make(uint32_t stencilCell) {
    collectHalves(stencilCell);
    collectUses(stencilCell);
    chunk_.shells.reset(chunk_.halves.halfFaces.size());
    for (const EdgeTable::Edge& edge : chunk_.table.edges) linkAround(edge);
    if (hasFloatingShell()) {
      nestFloatingShells({surface_, stencil_, faces_, chunk_.halves}, chunk_.shells, chunk_.predicates);
    }
    emit(stencilCell);
  }

 private:
  /// A half-face of a grid-face of the cell, by the one seen from below.
  static HalfFace seenFrom(int side, HalfFace fromBelow) { return side == 1 ? fromBelow : fromBelow.twin(); }

  void collectHalves(uint32_t stencilCell) {
    CellHalves& cell = chunk_.halves;
    cell.stencilCell = stencilCell;
    cell.triFaces = stencil_.triFacesInCell[stencilCell];
    cell.halfFaces.clear();
    for (const uint32_t f : cell.triFaces) {
      cell.halfFaces.push_back(HalfFace(FaceId{f}, 0));
      cell.halfFaces.push_back(HalfFace(FaceId{f}, 1));
    }
    for (int i = 0; i < 6; ++i) {
      for (const HalfFace h : faces_.grid.halfFaces[stencil_.cells[stencilCell].faces[i]]) cell.halfFaces.push_back(seenFrom(i & 1, h));
    }
  }

  void collectUses(uint32_t stencilCell) {
    chunk_.table.clear(countUses(stencilCell));
    addTriFaces();
    addGridFaces();
    for (int i = 0; i < 6; ++i) addSlits(i, faces_.grid.slits[stencil_.cells[stencilCell].faces[i]]);
  }

  size_t countUses(uint32_t stencilCell) const {
    const CellHalves& cell = chunk_.halves;
    size_t most = 0;
    for (size_t h = 0; h < cell.halfFaces.size(); h += h < cell.triHalves() ? 2 : 1) {
      for (const auto loop : faces_.loops(cell.halfFaces[h].face())) most += loop.size();
    }
    for (const uint32_t g : stencil_.cells[stencilCell].faces) most += 2 * faces_.grid.slits[g].size();
    return most;
  }

  void addTriFaces() {
    const CellHalves& cell = chunk_.halves;
    touchesLine_ = false;
    for (uint32_t i = 0; i < cell.triFaces.size(); ++i) {
      touchesLine_ |= faces_.tri.touchesLine[cell.triFaces[i]] != 0;
      const auto loop = faces_.tri.loop(cell.triFaces[i]);
      for (size_t k = 0; k < loop.size(); ++k) chunk_.table.add(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0], 2 * i, true);
    }
  }

  void addGridFaces() {
    const CellHalves& cell = chunk_.halves;
    for (uint32_t h = uint32_t(cell.triHalves()); h < cell.halfFaces.size(); ++h) {
      const bool reversed = cell.halfFaces[h].side() == 1;
      for (const auto loop : faces_.loops(cell.halfFaces[h].face())) {
        for (size_t k = 0; k < loop.size(); ++k) {
          const uint32_t u = loop[k], v = loop[k + 1 < loop.size() ? k + 1 : 0];
          reversed ? chunk_.table.add(v, u, h, false) : chunk_.table.add(u, v, h, false);
        }
      }
    }
  }

  /// `side`: which of the cell's grid-faces they lie in.
  void addSlits(int side, std::span<const Slit> slits) {
    const CellHalves& cell = chunk_.halves;
    for (const Slit& slit : slits) {
      const uint32_t h = cell.localOf(seenFrom(side & 1, slit.halfFace));
      chunk_.table.add(slit.from, slit.to, h, false);
      chunk_.table.add(slit.to, slit.from, h, false);
    }
  }

  /// Joins the two half-faces of every wedge around an edge. Angles grow counter-clockwise about the edge from its lower vertex to its
  /// higher. A tri-cut-face that runs upward has its normal towards growing angles; a half-face of a grid-face that runs upward has the
  /// cell on the side of smaller angles, so it comes last, and one that runs downward comes first.
  void linkAround(const EdgeTable::Edge& edge) {
    auto& around = chunk_.around;
    around.clear();
    uint32_t first = EdgeTable::kEnd, last = EdgeTable::kEnd;
    int gridUses = 0;
    for (uint32_t u = edge.firstUse; u != EdgeTable::kEnd; u = chunk_.table.uses[u].next) {
      const EdgeTable::Use& use = chunk_.table.uses[u];
      if (use.isTri) {
        around.push_back(use);
      } else {
        (use.ascending ? last : first) = use.local;
        ++gridUses;
      }
    }
    const bool open = first != EdgeTable::kEnd && last != EdgeTable::kEnd;
    if (gridUses != (open ? 2 : 0)) failAt(edge);
    if (!open && touchesLine_ && onGridElement(edge)) failAt(edge);
    if (around.size() > (open ? 1 : 2)) sortAround(edge, open);
    const auto before = [](const EdgeTable::Use& use) {
      return use.local + (use.ascending ? 0 : 1);
    };  // the half-face towards smaller angles
    const auto after = [](const EdgeTable::Use& use) { return use.local + (use.ascending ? 1 : 0); };
    uint32_t previous = open ? first : after(around.back());
    for (const EdgeTable::Use& use : around) {
      chunk_.shells.unite(previous, before(use));
      previous = after(use);
    }
    if (open) chunk_.shells.unite(previous, last);
  }

  bool onGridElement(const EdgeTable::Edge& edge) const {
    const Slab &a = vertices_.slabs[edge.low], &b = vertices_.slabs[edge.high];
    bool on = false;
    for (int d = 0; d < 3; ++d) on |= onPlane(a[d]) && a[d] == b[d];
    return on;
  }

  /// P6: sorts the tri-cut-faces around an edge by angle; if open, they span less than half a turn.
  void sortAround(const EdgeTable::Edge& edge, bool open) {
    auto& around = chunk_.around;
    std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) { return a.local < b.local; });
    const auto triangleOf = [&](const EdgeTable::Use& use) { return faces_.tri.triangles[chunk_.halves.triFaces[use.local / 2]]; };
    std::vector<Flap> flaps;
    const Point *a = nullptr, *b = nullptr;  // ends of the tri-edge, in the edge's direction
    for (uint32_t i = 0; i < around.size(); ++i) {
      const uint32_t triangle = triangleOf(around[i]);
      const auto& t = surface_.input.triangles[triangle];
      const int side = sideThrough(triangle, edge.low, edge.high);
      if (side < 0) failAt(edge);
      if (!a) {
        a = &surface_.input.points[t[side]];
        b = &surface_.input.points[t[(side + 1) % 3]];
        if (!around[i].ascending) std::swap(a, b);
      }
      flaps.push_back({&surface_.input.points[t[(side + 2) % 3]], i});
    }
    const size_t equal = sortRadially(*a, *b, open, flaps, chunk_.predicates);
    if (equal > 0) vertices_.failSelfIntersection(triangleOf(around[flaps[equal - 1].item]), triangleOf(around[flaps[equal].item]));
    const std::vector<EdgeTable::Use> unsorted = around;
    for (size_t i = 0; i < flaps.size(); ++i) around[i] = unsorted[flaps[i].item];
  }

  /// The side of a triangle that holds both vertices, or -1.
  int sideThrough(uint32_t triangle, uint32_t u, uint32_t v) const {
    for (int side = 0; side < 3; ++side) {
      bool holdsU = false, holdsV = false;
      surface_.edges.forSide(surface_.input, triangle, side, [&](uint32_t edge, bool) {
        const auto on = [&](uint32_t w) {
          return vertices_.isTriVertex(w) ? surface_.edges.ends[edge][0] == w || surface_.edges.ends[edge][1] == w
                                          : vertices_.isOnEdge(w) && vertices_.triEdge(w) == edge;
        };
        holdsU |= on(u);
        holdsV |= on(v);
      });
      if (holdsU && holdsV) return side;
    }
    return -1;
  }

  /// Faces that can't come from a surface without intersections meet at this edge.
  [[noreturn]] void failAt(const EdgeTable::Edge& edge) const {
    int64_t found[2] = {-1, -1};
    const auto note = [&](int64_t triangle) {
      if (triangle < 0 || triangle == found[0]) return;
      (found[0] < 0 ? found[0] : found[1]) = triangle;
    };
    for (uint32_t u = edge.firstUse; u != EdgeTable::kEnd; u = chunk_.table.uses[u].next) {
      const EdgeTable::Use& use = chunk_.table.uses[u];
      note(faces_.triangle(chunk_.halves.halfFaces[use.local].face()));
    }
    note(vertices_.triangleAt(edge.low));
    note(vertices_.triangleAt(edge.high));
    for (const uint32_t f : chunk_.halves.triFaces) {  // another one that has a vertex on the same grid-edge
      for (const uint32_t v : faces_.tri.loop(f)) {
        const Slab along = elementBetween(vertices_.slabs[edge.low], vertices_.slabs[edge.high]);
        if (found[1] < 0 && vertices_.slabs[v] == along) note(faces_.tri.triangles[f]);
      }
    }
    vertices_.failSelfIntersection(found[0], found[1] < 0 ? found[0] : found[1]);
  }

  bool hasFloatingShell() {
    const CellHalves& cell = chunk_.halves;
    auto& anchored = chunk_.counts;
    anchored.assign(cell.halfFaces.size(), 0);
    for (uint32_t h = uint32_t(cell.triHalves()); h < cell.halfFaces.size(); ++h) anchored[chunk_.shells.find(h)] = 1;
    for (uint32_t h = 0; h < cell.triHalves(); ++h) {
      if (!anchored[chunk_.shells.find(h)]) return true;
    }
    return false;
  }

  /// Cut-cells in the order of their first local half-face.
  void emit(uint32_t stencilCell) {
    const CellHalves& cell = chunk_.halves;
    auto& cellOf = chunk_.cellOf;
    auto& counts = chunk_.counts;
    cellOf.assign(cell.halfFaces.size(), 0);
    counts.clear();
    for (uint32_t h = 0; h < cell.halfFaces.size(); ++h) {
      const uint32_t root = chunk_.shells.find(h);  // the lowest, so numbered before the others
      if (root == h) {
        cellOf[h] = uint32_t(counts.size());
        counts.push_back(0);
        chunk_.cells.stencilCells.push_back(stencilCell);
      }
      cellOf[h] = cellOf[root];
      ++counts[cellOf[h]];
    }
    Csr<HalfFace>& out = chunk_.cells.halfFaces;
    uint32_t at = uint32_t(out.items.size());
    out.items.resize(at + cell.halfFaces.size());
    for (uint32_t& count : counts) {
      const uint32_t size = count;
      count = at;
      at += size;
      out.offsets.push_back(at);
    }
    for (uint32_t h = 0; h < cell.halfFaces.size(); ++h) out.items[counts[cellOf[h]]++] = cell.halfFaces[h];
  }

  const Surface& surface_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  const CutFaces& faces_;
  Chunk& chunk_;
  bool touchesLine_ = false;  ///< whether a tri-cut-face of the cell has a vertex on a grid line
};

}  // namespace

CutCells makeCutCells(const Surface& surface, const Stencil& stencil, const CutFaces& faces, Run& run) {
  auto chunks = forChunks<Chunk>(stencil.cells.size(), run.monitor, [&](Chunk& chunk, size_t begin, size_t end) {
    CellMaker maker(surface, stencil, faces, chunk);
    for (size_t c = begin; c < end; ++c) maker.make(uint32_t(c));
  });
  CutCells cells = std::move(chunks[0].cells);
  for (size_t c = 0; c < chunks.size(); ++c) {
    run.count(chunks[c].predicates);
    if (c == 0) continue;
    const CutCells& more = chunks[c].cells;
    const uint32_t shift = uint32_t(cells.halfFaces.items.size());
    for (size_t i = 1; i < more.halfFaces.offsets.size(); ++i) cells.halfFaces.offsets.push_back(more.halfFaces.offsets[i] + shift);
    cells.halfFaces.items.insert(cells.halfFaces.items.end(), more.halfFaces.items.begin(), more.halfFaces.items.end());
    cells.stencilCells.insert(cells.stencilCells.end(), more.stencilCells.begin(), more.stencilCells.end());
  }
  return cells;
}

}  // namespace mandoline::detail
